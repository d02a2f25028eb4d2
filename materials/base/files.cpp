#include "materials/base/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/unfinished.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Why no file can be created in an existing folder; "" if one can. Creates an empty one and
/// removes it: permissions do not show what a file system of the kernel or the network permits.
std::string why_no_file_in(const fs::path& folder) {
    const fs::path trial = temporary_beside(folder / "trial");
    const int file = ::open(trial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return std::strerror(errno);
    ::close(file);
    ::unlink(trial.c_str());
    return "";
}

/// Throws InputError if a path does not name a file in a folder.
void check_file_name(const fs::path& path) {
    std::error_code problem;
    const fs::file_status status = fs::status(path, problem);
    if (path.empty() || !path.has_filename()) {
        throw InputError(path.string(), "is not a valid file name for output");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw InputError(path.string(), "is not a regular file and would be replaced by results",
                         "expected the name of a file");
    }
    if (path.has_parent_path() && !fs::is_directory(path.parent_path(), problem)) {
        throw InputError(path.string(), "cannot be written: the folder does not exist");
    }
}

}  // namespace

std::ifstream open_file(const fs::path& path, std::uintmax_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw InputError(path.string(), "no such file");
    if (!fs::is_regular_file(status)) throw InputError(path.string(), "not a regular file");
    const std::uintmax_t size = fs::file_size(path, code);
    if (code || size > limit) {
        throw InputError(path.string(), "the file has " + std::to_string(size) +
                                            " bytes, expected at most " + std::to_string(limit));
    }
    note_file_read(path);
    return std::ifstream(path, std::ios::binary);
}

std::string read_text(const fs::path& path, std::size_t limit) {
    const std::ifstream file = open_file(path, limit);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw InputError(path.string(), "cannot be read");
    return std::move(text).str();
}

void write_whole_file(const fs::path& path, std::span<const std::byte> bytes) {
    check_file_name(path);
    UnfinishedFile file(path);
    file.write(bytes);
    file.finish();
}

void write_whole_file(const fs::path& path, std::string_view text) {
    write_whole_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

void check_output_file(const fs::path& path, const std::vector<FileRead>& inputs) {
    check_file_name(path);
    std::error_code problem;
    for (const FileRead& input : inputs) {
        if (!fs::equivalent(path, input.path, problem)) continue;
        throw InputError(path.string(),
                         "is an input or a result of this run and would be overwritten",
                         "choose another name");
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (const std::string why = why_no_file_in(folder); !why.empty()) {
        throw InputError(path.string(), "cannot be written: " + why, "choose another folder");
    }
}

std::string why_no_output_folder(const fs::path& folder) {
    std::error_code problem;
    const fs::file_status status = fs::status(folder, problem);
    if (!fs::exists(status) && fs::is_symlink(fs::symlink_status(folder, problem))) {
        return "is a broken symbolic link";
    }
    if (fs::exists(status) && !fs::is_directory(status)) return "is not a folder";
    fs::path there = fs::absolute(folder).lexically_normal();
    while (!fs::exists(there, problem) && there != there.parent_path()) {
        there = there.parent_path();
    }
    if (!fs::is_directory(there, problem)) {
        return "cannot be created: " + there.string() + " is not a folder";
    }
    const std::string reason = why_no_file_in(there);
    if (reason.empty()) return "";
    return fs::exists(status) ? "cannot be written to: " + reason
                              : "cannot be created in " + there.string() + ": " + reason;
}

}  // namespace diurna
