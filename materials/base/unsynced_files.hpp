#pragma once

#include <filesystem>

namespace diurna {

/// While one exists, finished files (materials/base/unfinished.hpp) are complete for every process
/// but not forced to the disk one by one, which takes longer than writing small ones. For files
/// whose content is checked before they are used again.
class UnsyncedFiles {
 public:
    /// - folder: of the files
    explicit UnsyncedFiles(std::filesystem::path folder);
    ~UnsyncedFiles();
    UnsyncedFiles(const UnsyncedFiles&) = delete;
    UnsyncedFiles& operator=(const UnsyncedFiles&) = delete;

    /// Forces all written so far to the disk, and later files one by one again. Throws
    /// std::runtime_error where that fails.
    void sync();

 private:
    std::filesystem::path folder_;
    bool open_ = true;
};

}  // namespace diurna
