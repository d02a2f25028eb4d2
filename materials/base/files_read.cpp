#include "materials/base/files_read.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// By device and node: a file named in two ways is one.
using Watched = std::map<std::pair<std::uint64_t, std::uint64_t>, FileRead>;

std::mutex watching;
std::map<const FilesRead*, Watched> watchers;

std::vector<FileRead> by_path(const Watched& watched) {
    std::vector<FileRead> files;
    for (const auto& [node, file] : watched) files.push_back(file);
    std::sort(files.begin(), files.end(),
              [](const FileRead& a, const FileRead& b) { return a.path < b.path; });
    return files;
}

std::optional<FileRead> as_it_is(const fs::path& path) {
    struct stat is {};
    if (::stat(path.c_str(), &is) != 0 || !S_ISREG(is.st_mode)) return std::nullopt;
    return FileRead{.path = path,
                    .size = static_cast<std::uintmax_t>(is.st_size),
                    .changed = std::int64_t{is.st_mtim.tv_sec} * 1'000'000'000 + is.st_mtim.tv_nsec,
                    .device = is.st_dev,
                    .node = is.st_ino};
}

}  // namespace

bool is_unchanged(const FileRead& file) { return as_it_is(file.path) == file; }

FilesRead::FilesRead() {
    const std::lock_guard lock(watching);
    watchers[this];
}

FilesRead::~FilesRead() {
    const std::lock_guard lock(watching);
    watchers.erase(this);
}

std::vector<FileRead> FilesRead::files() const {
    const std::lock_guard lock(watching);
    return by_path(watchers.at(this));
}

std::vector<FileRead> merged(const std::vector<FileRead>& first,
                             const std::vector<FileRead>& second) {
    Watched all;
    for (const std::vector<FileRead>* list : {&first, &second}) {
        for (const FileRead& file : *list) all.try_emplace({file.device, file.node}, file);
    }
    return by_path(all);
}

void note_file_read(const fs::path& file) {
    const std::lock_guard lock(watching);
    if (watchers.empty()) return;
    const std::optional<FileRead> found = as_it_is(file.lexically_normal());
    if (!found) return;
    for (auto& [watcher, files] : watchers) {
        files.try_emplace({found->device, found->node}, *found);
    }
}

}  // namespace diurna
