#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace diurna {

/// A file that is being written, under a name beside its own that nobody can guess. It takes its
/// own name when it is whole; before, whatever ends it, there is nothing of it: not where its
/// writer fails, and not at an interrupt (`remove_unfinished_at_signals`).
class UnfinishedFile {
 public:
    /// Makes it, empty. Throws std::runtime_error with path and reason.
    explicit UnfinishedFile(const std::filesystem::path& target);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

    /// For another program that writes it.
    const std::filesystem::path& path() const { return path_; }
    void write(std::span<const std::byte> bytes);
    /// Flushed to disk, renamed, and the folder's entry flushed.
    void finish();
    /// Renamed, flushed whenever the system does: for what can be reported to be torn, and
    /// regenerated.
    void rename();

 private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path target_, path_;
    int file_ = -1;
    int slot_ = -1;
};

/// A name beside a file that nobody can guess, for it while it is unfinished.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Whether a file's name is one that unfinished files have: ".NAME.PROCESS.RANDOM.part".
bool is_temporary_name(const std::string& name);

/// Whether it has such a name, of a process that lives no more.
bool is_left_over(const std::filesystem::path& file);

/// A new folder for what lasts no longer than the program's use of it. Goes with its contents where
/// the object ends, and with the files in it (not with folders in it) at a signal that ends the
/// program.
class TemporaryFolder {
 public:
    /// Made where the system keeps temporary files, as NAME-XXXXXX. Throws std::runtime_error.
    explicit TemporaryFolder(const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    int slot_ = -1;
};

/// Where the program has to end at once: writes the line to stderr, removes what is unfinished,
/// ends child processes and leaves with 1. Neither locks nor allocates.
[[noreturn]] void end_at_once(std::string_view line);

/// Signals that end the program unless it was started without them (nohup).
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};

/// From here on these remove what is unfinished and end child processes, and then the program as
/// they do by themselves (128 + number to a shell). One that the program was started without
/// (nohup) stays ignored.
void remove_unfinished_at_signals();

/// A process group that is killed where a signal ends the program. Returns its place, for
/// no_longer_end(); -1 where there is no place for more.
int end_with_program(pid_t group);
void no_longer_end(int place);

}  // namespace diurna
