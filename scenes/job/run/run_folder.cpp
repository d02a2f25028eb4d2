#include "scenes/job/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/unfinished.hpp"
#include "scenes/job/plan/sweep_folder.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/listed_outputs.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Folders of a run's, all of whose files are a run's.
constexpr const char* own_folders[] = {"frames", "images", "labels", "kitti", "kitti/calib"};

/// Whether anything but folders and temporary files lies beneath.
bool holds_files(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const bool counts = !entry.is_directory() || entry.is_symlink();
        if (counts && !is_temporary_name(entry.path().filename().string())) return true;
    }
    return false;
}

/// "frames/east_8-12_20260715T040000Z.exr" -> "east_8-12_20260715T040000Z"
std::string stem_of(const std::string& name) { return fs::path(name).stem().string(); }

[[noreturn]] void refuse(const fs::path& out, const std::string& found, const std::string& hint) {
    throw InputError("--out", fmt::format("{} {}", out.string(), found), hint);
}

[[noreturn]] void refuse_used(const fs::path& out) {
    refuse(out, "is in use by another run", "wait until that run ends, or choose another folder");
}

/// Whether this process has the folder now; else errno has the reason.
bool lock(int file, bool shared) {
    return ::flock(file, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0;
}

/// Of earlier runs, found in a run's folder.
struct OldFiles {
    std::vector<fs::path> file;  // to be removed
    Cleared cleared;
};

/// Throws InputError for another file among pictures or labels. The arguments are those of
/// clear_run_folder().
OldFiles old_files(const fs::path& out, const std::set<std::string>& keep,
                   const std::vector<std::string>& expected) {
    const std::set<std::string> wanted(expected.begin(), expected.end());
    std::set<std::string> known = wanted, stems;
    for (std::string& name : ledger_names(out)) known.insert(std::move(name));
    for (const auto& [name, digest] : listed_outputs(out).digest) known.insert(name);
    for (const std::string& name : known) stems.insert(stem_of(name));
    std::set<std::string> wanted_stems;
    for (const std::string& name : wanted) wanted_stems.insert(stem_of(name));

    OldFiles old;
    const auto sort_out = [&](const std::string& folder, bool own) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(out / folder, none)) {
            const std::string file = entry.path().filename().string();
            const std::string name = folder.empty() ? file : folder + "/" + file;
            const bool inner = entry.is_directory() && !entry.is_symlink();
            if (keep.contains(name) || (inner && name == "kitti/calib")) continue;
            const bool ours = !inner && (known.contains(name) || is_temporary_name(file) ||
                                         (own && stems.contains(stem_of(file))));
            if (ours) {
                old.file.push_back(entry.path());
                if (!own || is_temporary_name(file)) continue;
                if (!wanted_stems.contains(stem_of(file))) {
                    ++old.cleared.gone;
                } else if (wanted.contains(name)) {
                    ++old.cleared.again;
                }  // else labels, which are written at the end of each run
            } else if (own) {
                refuse(out,
                       fmt::format(
                           "holds {}, which was not written by an earlier run of this scene", name),
                       "remove it, or choose another folder");
            }
        }
    };
    sort_out("", false);
    for (const char* folder : own_folders) sort_out(folder, true);
    return old;
}

}  // namespace

void check_run_folder(const fs::path& out, FolderKind kind) {
    if (const std::string why = why_no_output_folder(out); !why.empty()) {
        refuse(out, why, "expected a folder or a new name");
    }
    std::error_code problem;
    if (!fs::exists(out, problem)) return;
    for (const char* inner : own_folders) {
        if (fs::is_symlink(fs::symlink_status(out / inner, problem))) {
            refuse(out, fmt::format("has a symbolic link in place of its folder {}", inner), "");
        }
    }
    const bool of_sweep = is_sweep_folder(out), written = of_sweep || is_listed(out);
    if (written && of_sweep != (kind == FolderKind::sweep) && holds_files(out)) {
        refuse(out, of_sweep ? "holds the results of a sweep" : "holds the results of a run",
               "choose another folder");
    }
    if (written || !holds_files(out)) return;
    refuse(out, "holds files that are not results of a run", "choose another folder, new or empty");
}

bool is_results_folder(const fs::path& folder) {
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(folder, problem);
    if (is_listed(whole) || is_sweep_folder(whole)) return true;
    fs::path inner;
    for (fs::path around = whole; around.has_relative_path();) {
        inner = around.filename() / inner;
        around = around.parent_path();
        const std::string first = inner.begin()->string();
        if (is_listed(around) && std::find(std::begin(own_folders), std::end(own_folders), first) !=
                                     std::end(own_folders)) {
            return true;
        }
        if ((first == "variants" || first == "heat") && is_sweep_folder(around)) return true;
    }
    return false;
}

void check_not_in_use(const fs::path& out, bool shared) {
    const int file = ::open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    const bool used = !lock(file, shared) && errno == EWOULDBLOCK;
    ::close(file);
    if (used) refuse_used(out);
}

void check_no_input_in(const fs::path& out, const std::vector<fs::path>& inputs) {
    const fs::path folder = fs::weakly_canonical(out);
    for (const fs::path& input : inputs) {
        const fs::path below = fs::weakly_canonical(input).lexically_relative(folder);
        if (below.empty() || *below.begin() == "..") continue;
        refuse(out, fmt::format("holds {}, an input of this run", input.string()),
               "choose another folder");
    }
}

FolderLock::FolderLock(const fs::path& folder, bool shared) {
    fs::create_directories(folder);
    file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ < 0) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", folder.string(), std::strerror(errno)));
    }
    if (lock(file_, shared)) return;
    const int reason = errno;
    if (reason == EWOULDBLOCK) {
        ::close(file_);
        refuse_used(folder);
    }
    // File systems of networks may know no locks of folders: then the folder is not guarded.
    fmt::print(stderr,
               "note: {} cannot be locked, so another run may write to it at the same time: {}\n",
               folder.string(), std::strerror(reason));
}

FolderLock::~FolderLock() { ::close(file_); }

void clear_run_folder(const fs::path& out, const std::set<std::string>& keep,
                      const std::vector<std::string>& expected,
                      const std::function<void(const Cleared&)>& tell) {
    const OldFiles old = old_files(out, keep, expected);
    if (tell && old.cleared.again + old.cleared.gone > 0) tell(old.cleared);
    for (const fs::path& file : old.file) fs::remove(file);
}

void check_clearable(const fs::path& out, const std::vector<std::string>& expected) {
    old_files(out, {}, expected);
}

}  // namespace diurna
