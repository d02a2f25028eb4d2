#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diurna {

/// How a child process is started.
struct ChildStart {
    std::vector<std::string> words;  // name of the program and its arguments
    bool on_path = false;            // searched for on the PATH; else words[0] is a path
    /// NAME=VALUE; nullopt: the environment of this program.
    std::optional<std::vector<std::string>> environment{};
    std::filesystem::path folder{};  // working folder; "": the current one
    int input = -1;                  // file descriptor of its stdin; -1: /dev/null
    bool prints_errors = false;      // to this program's stderr; else to /dev/null
};

/// A child process, leader of its own process group, which includes all processes it starts. The
/// whole group is killed when the object is destroyed, also by an exception, and when a signal ends
/// this program (materials/base/unfinished.hpp); no process is left running.
class ChildProcess {
 public:
    /// Throws std::system_error where it cannot be started.
    explicit ChildProcess(const ChildStart& start);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Whether it has ended; then `status` is set as by waitpid().
    bool ended(int& status);
    /// Waits for its end. Returns the status.
    int wait();

 private:
    pid_t id_ = -1;
    int slot_ = -1;
    bool reaped_ = false;
    int status_ = 0;
};

}  // namespace diurna
