#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "scenes/job/store/inputs.hpp"

/// The results folder: used by one run only, and never one with a user's own files.
namespace diurna {

enum class FolderKind { run, sweep };

/// Throws InputError if results cannot be written there: a file, a device, a folder with other
/// content than an earlier run's (or sweep's) results. Writes nothing.
void check_run_folder(const std::filesystem::path& out, FolderKind kind);

/// Whether a folder is that of a run or sweep, or one inside it that its files fill ("frames",
/// "variants/v0").
bool is_results_folder(const std::filesystem::path& folder);

/// Throws InputError if another process has locked it (FolderLock). Writes nothing, and locks
/// nothing either.
///
/// - shared: the lock that is to follow
void check_not_in_use(const std::filesystem::path& out, bool shared = false);

/// Throws InputError if an input is in the folder: results would overwrite
/// it.
void check_no_input_in(const std::filesystem::path& out,
                       const std::vector<std::filesystem::path>& inputs);

/// Throws InputError as clear_run_folder() would. Removes nothing.
///
/// - expected: of the run that begins
void check_clearable(const std::filesystem::path& out, const std::vector<std::string>& expected);

/// A folder that is created if necessary and locked by this process while the object exists; the
/// system releases the lock when the process ends. Throws InputError if another process has it.
///
/// - shared: with others that share it: the shards of a sweep
class FolderLock {
 public:
    explicit FolderLock(const std::filesystem::path& folder, bool shared = false);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    int file_ = -1;
};

/// Treatment of earlier runs' files: number of pictures that are rewritten, and number of pictures
/// and labels that are removed and not rewritten.
struct Cleared {
    std::size_t again = 0, gone = 0;
};

/// Removes files of earlier runs from a run's folder: those they list, pictures and labels of the
/// same names, temporary files of killed runs. Throws InputError, and removes nothing, if another
/// file is among the pictures or labels.
///
/// - keep: names that are not removed
/// - expected: of the run that begins
/// - tell: called before anything is removed, if any picture or label is
void clear_run_folder(const std::filesystem::path& out, const std::set<std::string>& keep,
                      const std::vector<std::string>& expected,
                      const std::function<void(const Cleared&)>& tell = {});

}  // namespace diurna
