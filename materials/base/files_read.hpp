#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

/// Which files a scene is made of, found by watching what is opened, not by a list that would have
/// to be kept: spectra, tables, sidecars, what a mesh names in turn.
namespace diurna {

/// A file, and what it was when it was first opened.
struct FileRead {
    std::filesystem::path path;  // as it was named, in its normal form
    std::uintmax_t size = 0;     // [bytes]
    std::int64_t changed = 0;    // [ns] when its content was last written
    std::uint64_t device = 0, node = 0;

    bool operator==(const FileRead&) const = default;
};

/// Whether the file still is what was opened; false where it is gone.
bool is_unchanged(const FileRead& file);

/// Notes, while it lives, each file that any thread of the program reads. Several may live at a
/// time; each has all of what was opened meanwhile.
class FilesRead {
 public:
    FilesRead();
    ~FilesRead();
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    /// Ascending by path, each once.
    std::vector<FileRead> files() const;
};

/// The two lists as one, ascending by path; of a file in both that of the first.
std::vector<FileRead> merged(const std::vector<FileRead>& first,
                             const std::vector<FileRead>& second);

/// Every reader calls it before it opens a file, and for those that a library has opened by itself.
/// One that is not there is no file read.
void note_file_read(const std::filesystem::path& file);

}  // namespace diurna
