#pragma once

#include <sys/types.h>

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
    /// Renamed, flushed whenever the system does: for what can be told to be torn, and made anew.
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

/// Where the program has to end at once: writes the line to stderr, removes what is unfinished,
/// ends a child process and leaves with 1. Neither locks nor allocates.
[[noreturn]] void end_at_once(std::string_view line);

/// From here on SIGINT, SIGTERM and SIGHUP remove what is unfinished and end a child process, and
/// then the program as they do by themselves (128 + number to a shell). One that the program was
/// started without (nohup) stays ignored.
void remove_unfinished_at_signals();

/// The process group that ends with the program at a signal; 0: none.
void set_child_group(pid_t group);

}  // namespace diurna
