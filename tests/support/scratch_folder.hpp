#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// A folder of a test's own that goes when the test does.
struct ScratchFolder {
    std::filesystem::path path;
    explicit ScratchFolder(const std::string& name)
        : path(std::filesystem::temp_directory_path() /
               ("diurna-" + name + "-" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    ~ScratchFolder() {
        std::error_code code;
        std::filesystem::remove_all(path, code);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
};

/// Makes the temporary folder of this process its own, so that tests that run at the same time do
/// not meet there: one object of it at the top of a test file. Those of one process share it.
struct PrivateTempFolder {
    const ScratchFolder& folder;
    PrivateTempFolder() : folder(of_process()) { ::setenv("TMPDIR", folder.path.c_str(), 1); }

 private:
    static const ScratchFolder& of_process() {
        static const ScratchFolder made{"test"};
        return made;
    }
};
