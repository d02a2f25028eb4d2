#pragma once

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

/// What a command of the shell has ended with.
struct Ran {
    int code;
    std::string out;  // what it has printed; of stderr what the command sends there
};

inline Ran ran(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    Ran result{0, ""};
    std::array<char, 4096> block{};
    while (const std::size_t count = fread(block.data(), 1, block.size(), pipe)) {
        result.out.append(block.data(), count);
    }
    result.code = WEXITSTATUS(pclose(pipe));
    return result;
}
