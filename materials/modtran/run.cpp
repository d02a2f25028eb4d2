#include "materials/modtran/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

/// A new folder that goes with its contents.
class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string pattern = (fs::temp_directory_path() / "diurna-modtran-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) {
            throw std::runtime_error(fmt::format("{}: {}", pattern, std::strerror(errno)));
        }
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

 private:
    fs::path path_;
};

/// Bytes of all files in a folder; files that come and go meanwhile count as they can.
std::uintmax_t bytes_in(const fs::path& folder) {
    std::uintmax_t sum = 0;
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(folder, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        std::error_code gone;
        if (!it->is_symlink(gone) && it->is_regular_file(gone)) {
            const std::uintmax_t size = it->file_size(gone);
            if (!gone) sum += size;
        }
    }
    return sum;
}

/// A child that is its process group's leader; killed with all of the group unless it was reaped.
class Child {
 public:
    Child(const fs::path& executable, const std::vector<std::string>& environment,
          const fs::path& folder) {
        std::string name = executable.string();
        std::vector<char*> argv = {name.data()}, envp;
        for (const std::string& each : environment) envp.push_back(const_cast<char*>(each.c_str()));
        argv.push_back(nullptr);
        envp.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawnattr_t attributes;
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        const int code =
            posix_spawn(&id_, executable.c_str(), &actions, &attributes, argv.data(), envp.data());
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
        if (code != 0) {
            id_ = -1;
            throw std::runtime_error(
                fmt::format("{}: cannot be started: {}", executable.string(), std::strerror(code)));
        }
    }
    ~Child() {
        if (id_ <= 0) return;
        ::kill(-id_, SIGKILL);  // what it has started lives in its group
        int status = 0;
        if (!reaped_) ::waitpid(id_, &status, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Whether it has ended; then `status` is set.
    bool ended(int& status) {
        reaped_ = reaped_ || ::waitpid(id_, &status, WNOHANG) == id_;
        return reaped_;
    }

 private:
    pid_t id_ = -1;
    bool reaped_ = false;
};

/// Runs the program in a folder until it ends, and returns its status; throws where it takes longer
/// or writes more than allowed.
int wait_for(const ModtranRunner& runner, const std::vector<std::string>& environment,
             const fs::path& folder) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::string name = runner.executable.string();
    Child child(runner.executable, environment, folder);
    int status = 0;
    for (auto nap = std::chrono::milliseconds(1); !child.ended(status);
         nap = std::min(2 * nap, std::chrono::milliseconds(50))) {
        if (Clock::now() - begin > runner.time_limit) {
            throw std::runtime_error(
                fmt::format("{}: stopped after {:.1f} s without an end", name,
                            std::chrono::duration<double>(runner.time_limit).count()));
        }
        if (bytes_in(folder) > runner.output_limit) {
            throw std::runtime_error(fmt::format("{}: stopped after writing more than {} bytes",
                                                 name, runner.output_limit));
        }
        std::this_thread::sleep_for(nap);
    }
    return status;
}

}  // namespace

std::optional<ModtranRunner> modtran_runner(const std::string& command_line_word) {
    const char* named = std::getenv("DIURNA_MODTRAN");
    const bool from_line = !command_line_word.empty();
    if (!from_line && (named == nullptr || *named == '\0')) return std::nullopt;
    const std::string where = from_line ? "--modtran" : "DIURNA_MODTRAN";
    ModtranRunner runner;
    runner.executable = from_line ? command_line_word : named;
    if (!runner.executable.is_absolute()) {
        throw InputError(where, fmt::format("found '{}', expected an absolute path",
                                            runner.executable.string()));
    }
    if (!fs::is_regular_file(runner.executable) || ::access(runner.executable.c_str(), X_OK) != 0) {
        throw InputError(where,
                         fmt::format("'{}' is not an executable file", runner.executable.string()));
    }
    if (const char* data = std::getenv("MODTRAN_DATA")) runner.data = data;
    return runner;
}

std::string run_modtran(const ModtranRunner& runner, const std::string& tape5) {
    const TemporaryFolder folder;
    write_whole_file(folder.path() / "tape5", tape5);
    const fs::path tape7 = folder.path() / "tape7";
    std::vector<std::string> environment = {"PATH=/usr/bin:/bin", "LANG=C"};
    if (!runner.data.empty()) environment.push_back("MODTRAN_DATA=" + runner.data.string());
    const int status = wait_for(runner, environment, folder.path());
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(
            fmt::format("{}: ended with {} {}", runner.executable.string(),
                        WIFEXITED(status) ? "code" : "signal",
                        WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)));
    }
    if (!fs::is_regular_file(fs::symlink_status(tape7))) {
        throw std::runtime_error(fmt::format("{}: left no file tape7", runner.executable.string()));
    }
    return read_text(tape7, runner.output_limit);
}

std::vector<Tape7Run> run_decks(const ModtranRunner& runner,
                                const std::vector<ModtranDeck>& decks) {
    const std::string text = run_modtran(runner, write_tape5(decks));
    std::vector<Tape7Run> runs = read_tape7_text("tape7 of " + runner.executable.string(), text);
    if (runs.size() != decks.size()) {
        throw std::runtime_error(
            fmt::format("MODTRAN gave {} paths, {} were asked for", runs.size(), decks.size()));
    }
    return runs;
}

}  // namespace diurna
