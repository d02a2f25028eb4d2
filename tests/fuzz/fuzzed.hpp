#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

/// What the harnesses of libFuzzer share: its bytes as a file among others, a judge of what a
/// reader sets, and a mutator that knows numbers, words and lines. Each harness is a source
/// of its own that includes this.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace fuzzed {

/// A folder in which one file is what is tried, beside others that are as they should be.
class Folder {
 public:
    explicit Folder(const std::map<std::string, std::string>& beside = {}) {
        for (const auto& [name, text] : beside) put(name, text);
    }
    std::filesystem::path put(const std::string& name, std::string_view text) const {
        const std::filesystem::path file = scratch_.path / name;
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
        return file;
    }

 private:
    ScratchFolder scratch_{"fuzz"};
};

/// Reading it ends with a result or with what is wrong with it; anything else is a finding.
inline int judge(const std::function<void()>& read) {
    try {
        read();
    } catch (const diurna::InputError&) {
    } catch (const std::exception& error) {
        std::fprintf(stderr, "not told as a mistake of input: %s\n", error.what());
        std::abort();
    }
    return 0;
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Where a word or number that holds `at` begins and ends.
inline std::array<std::size_t, 2> word_at(const std::string& text, std::size_t at) {
    const auto inside = [&](std::size_t i) {
        return std::isalnum(static_cast<unsigned char>(text[i])) || std::strchr("+-._:", text[i]);
    };
    std::size_t from = at, to = at;
    while (from > 0 && inside(from - 1)) --from;
    while (to < text.size() && inside(to)) ++to;
    return {from, to};
}

inline std::string strange(std::mt19937& random) {
    static const std::array<const char*, 28> values{"nan",
                                                    "inf",
                                                    "-inf",
                                                    "0",
                                                    "-0",
                                                    "-1",
                                                    "1e308",
                                                    "-1e308",
                                                    "5e-324",
                                                    "1e400",
                                                    "2147483648",
                                                    "4294967296",
                                                    "18446744073709551616",
                                                    "65536",
                                                    "0.1",
                                                    "1e9",
                                                    "-273.16",
                                                    "\"\"",
                                                    "[]",
                                                    "{}",
                                                    "true",
                                                    "[[]]",
                                                    "\"../x\"",
                                                    "2026-06-20",
                                                    "2026-06-20T12:00:00Z",
                                                    "9999-12-31T23:59:60Z",
                                                    "0x7f",
                                                    "1e-30"};
    return values[random() % values.size()];
}

/// One change to a text that leaves most of it as it was.
inline void change(std::string& text, std::mt19937& random) {
    if (text.empty()) return;
    const std::size_t at = random() % text.size();
    const auto [from, to] = word_at(text, at);
    const std::size_t line =
        text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string of_line = end > line ? text.substr(line, end - line) : "";
    switch (random() % 6) {
        case 0:
        case 1:
            text.replace(from, to - from, strange(random));
            break;
        case 2:
            text.erase(line, of_line.size());
            break;
        case 3:
            text.insert(line, of_line);
            break;
        case 4: {  // a word of elsewhere
            const auto [other, past] = word_at(text, random() % text.size());
            const std::string word = text.substr(other, past - other);
            text.replace(from, to - from, word);
            break;
        }
        default:  // a line of elsewhere
            const std::size_t other = random() % text.size();
            const std::size_t begin =
                text.rfind('\n', other) == std::string::npos ? 0 : text.rfind('\n', other) + 1;
            const std::string copy = text.substr(begin, text.find('\n', begin) - begin + 1);
            text.insert(line, copy);
    }
}

}  // namespace fuzzed

/// Half the time bytes as libFuzzer has it, half the time words and lines.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    std::mt19937 random(seed);
    if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
    std::string text = fuzzed::text_of(data, size);
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes) fuzzed::change(text, random);
    const std::size_t kept = std::min(most, text.size());
    std::memcpy(data, text.data(), kept);
    return kept;
}
