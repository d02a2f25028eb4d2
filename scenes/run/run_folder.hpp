#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "scenes/cache/inputs.hpp"

/// The folder that results go to: one run's alone, never another's and never a user's own.
namespace diurna {

enum class FolderKind { run, sweep };

/// Throws InputError where results cannot go: a file, a device, a folder that holds something else
/// than an earlier run's (or sweep's) results. Writes nothing.
void check_run_folder(const std::filesystem::path& out, FolderKind kind);

/// Throws InputError where an input lies in the folder: results would go over what they are made
/// of.
void check_no_input_in(const std::filesystem::path& out, const std::vector<RunInput>& inputs);

/// A folder that is made if it is not there, and this process's alone while the object lives; the
/// system ends that when the process ends, however it does. Throws InputError where another has it.
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

/// What becomes of earlier runs' files: how many of pictures are written again, and how many of
/// pictures and labels are removed, not to be written again.
struct Cleared {
    std::size_t again = 0, gone = 0;
};

/// Removes what earlier runs have left in a run's folder: those files that they list, pictures and
/// labels of the same names, temporary files of killed runs. Throws InputError, and removes
/// nothing, where another file stands among the pictures or labels.
///
/// - keep: names that stay
/// - expected: of the run that begins
/// - tell: called before anything is removed, if any picture or label is
void clear_run_folder(const std::filesystem::path& out, const std::set<std::string>& keep,
                      const std::vector<std::string>& expected,
                      const std::function<void(const Cleared&)>& tell = {});

}  // namespace diurna
