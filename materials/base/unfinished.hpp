#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace diurna {

/// A file being written, under an unpredictable temporary name beside its final name. It gets the
/// final name when it is complete; otherwise it is removed, both when its writer fails and at an
/// interrupt (`remove_unfinished_at_signals`).
class UnfinishedFile {
 public:
    /// Creates it, empty. Throws std::runtime_error with path and reason.
    explicit UnfinishedFile(const std::filesystem::path& target);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

    /// For another program that writes the file.
    const std::filesystem::path& path() const { return path_; }
    void write(std::span<const std::byte> bytes);
    /// Flushes it to disk, renames it, and flushes the folder's entry.
    void finish();
    /// Renames it without flushing: for files whose damage is detected later and that can be
    /// regenerated.
    void rename();

 private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path target_, path_;
    int file_ = -1;
    int slot_ = -1;
};

/// An unpredictable temporary name beside a file, used while it is unfinished.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Whether a file's name is one that unfinished files have: ".NAME.PROCESS.RANDOM.part".
bool is_temporary_name(const std::string& name);

/// Whether it has such a name, from a process that no longer runs.
bool is_left_over(const std::filesystem::path& file);

/// A new temporary folder. It is removed with its contents when the object is
/// destroyed, and its files (not folders inside it) are removed at a signal that ends
/// the program.
class TemporaryFolder {
 public:
    /// Created in the system's temporary folder as NAME-XXXXXX. Throws std::runtime_error.
    explicit TemporaryFolder(const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    int slot_ = -1;
};

/// Ends the program immediately: writes the line to stderr, removes unfinished files, kills child
/// processes and exits with 1. Neither locks nor allocates.
[[noreturn]] void end_at_once(std::string_view line);

/// Signals that end the program unless it was started with them ignored (nohup).
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};

/// From this call on, these signals remove unfinished files, kill child processes and then end the
/// program as they do by default (128 + number to a shell). A signal that the program was started
/// with ignored (nohup) stays ignored.
void remove_unfinished_at_signals();

/// Registers a process group that is killed when a signal ends the program. Returns its index, for
/// no_longer_end(); -1 if the list is full.
int end_with_program(pid_t group);
void no_longer_end(int place);

}  // namespace diurna
