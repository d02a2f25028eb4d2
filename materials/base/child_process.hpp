#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diurna {

/// What another program is started with.
struct ChildStart {
    std::vector<std::string> words;  // name of the program and its arguments
    bool on_path = false;            // searched for on the PATH; else words[0] is its file
    /// NAME=VALUE; nullopt: this program's own.
    std::optional<std::vector<std::string>> environment{};
    std::filesystem::path folder{};  // it runs there; "": here
    int input = -1;                  // file descriptor of its stdin; -1: /dev/null
    bool prints_errors = false;      // to this program's stderr; else to /dev/null
};

/// Another program, leader of a process group of its own, in which all that it starts lives. The
/// whole group is killed where the object ends, where an exception is thrown, and where a signal
/// ends this program (materials/base/unfinished.hpp); none is left running.
class ChildProcess {
 public:
    /// Throws std::system_error where it cannot be started.
    explicit ChildProcess(const ChildStart& start);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Whether it has ended; then `status` is set, as waitpid() has it.
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
