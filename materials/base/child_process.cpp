#include "materials/base/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <system_error>

#include "materials/base/unfinished.hpp"

extern char** environ;

namespace diurna {

namespace {

/// Signals that end the program wait while it lives: between a child's start and the note of its
/// group none may come.
class SignalsWait {
 public:
    SignalsWait() {
        sigset_t ending;
        sigemptyset(&ending);
        for (const int signal : ending_signals) sigaddset(&ending, signal);
        pthread_sigmask(SIG_BLOCK, &ending, &before_);
    }
    ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsWait(const SignalsWait&) = delete;
    SignalsWait& operator=(const SignalsWait&) = delete;
    const sigset_t& before() const { return before_; }

 private:
    sigset_t before_;
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

int spawn(const ChildStart& start, const sigset_t& mask, pid_t& id) {
    std::vector<std::string> words = start.words,
                             environment = start.environment.value_or(std::vector<std::string>{});
    const std::vector<char*> argv = pointers(words);
    std::vector<char*> own = pointers(environment);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    if (start.input >= 0) {
        posix_spawn_file_actions_adddup2(&actions, start.input, 0);
    } else {
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    }
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    if (!start.prints_errors)
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    if (!start.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, start.folder.c_str());
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &mask);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    char** const envp = start.environment ? own.data() : environ;
    const int code = start.on_path
                         ? posix_spawnp(&id, argv[0], &actions, &attributes, argv.data(), envp)
                         : posix_spawn(&id, argv[0], &actions, &attributes, argv.data(), envp);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return code;
}

}  // namespace

ChildProcess::ChildProcess(const ChildStart& start) {
    const SignalsWait wait;
    if (const int code = spawn(start, wait.before(), id_); code != 0) {
        id_ = -1;
        throw std::system_error(code, std::generic_category());
    }
    slot_ = end_with_program(id_);
}

ChildProcess::~ChildProcess() {
    if (id_ <= 0) return;
    ::kill(-id_, SIGKILL);  // what it has started lives in its group
    wait();
    no_longer_end(slot_);
}

bool ChildProcess::ended(int& status) {
    reaped_ = reaped_ || ::waitpid(id_, &status_, WNOHANG) == id_;
    status = status_;
    return reaped_;
}

int ChildProcess::wait() {
    while (!reaped_) {
        const pid_t found = ::waitpid(id_, &status_, 0);
        reaped_ = found == id_ || (found < 0 && errno != EINTR);
    }
    return status_;
}

}  // namespace diurna
