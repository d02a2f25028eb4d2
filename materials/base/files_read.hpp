#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

/// The files that a scene is read from, recorded when they are opened instead of listed by hand:
/// spectra, tables, sidecars, files that a mesh names.
namespace diurna {

/// A file, and its size and time when it was first opened.
struct FileRead {
    std::filesystem::path path;  // path as it was named, normalised
    std::uintmax_t size = 0;     // [bytes]
    std::int64_t changed = 0;    // [ns] when its content was last written
    std::uint64_t device = 0, node = 0;

    bool operator==(const FileRead&) const = default;
};

/// Whether the file is still the one that was opened; false if it no longer exists.
bool is_unchanged(const FileRead& file);

/// While it exists, records each file that any thread of the program reads. Several may exist at a
/// time; each records all files opened since its creation.
class FilesRead {
 public:
    FilesRead();
    ~FilesRead();
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    /// Ascending by path, each once.
    std::vector<FileRead> files() const;
};

/// The two lists merged, ascending by path; a file in both is taken from the first.
std::vector<FileRead> merged(const std::vector<FileRead>& first,
                             const std::vector<FileRead>& second);

/// Every reader calls it before it opens a file, and for files that a library opens itself. A file
/// that does not exist is not recorded.
void note_file_read(const std::filesystem::path& file);

}  // namespace diurna
