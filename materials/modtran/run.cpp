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
#include "materials/modtran/deck.hpp"

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
    Child(const fs::path& executable, const std::vector<std::string>& arguments,
          const std::vector<std::string>& environment, const fs::path& folder) {
        std::vector<char*> argv, envp;
        for (const std::string& each : arguments) argv.push_back(const_cast<char*>(each.c_str()));
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

std::string run_modtran(const ModtranRunner& runner, const std::string& input_file,
                        const std::string& input, const std::string& result_file) {
    using Clock = std::chrono::steady_clock;
    for (const std::string& name : {input_file, result_file}) {
        if (name.empty() || name.find('/') != std::string::npos || name.starts_with('.')) {
            throw InputError("MODTRAN file", fmt::format("'{}' is not a plain file name", name));
        }
    }
    const TemporaryFolder folder;
    write_whole_file(folder.path() / input_file, input);
    std::vector<std::string> environment = {"PATH=/usr/bin:/bin", "LANG=C"};
    if (!runner.data.empty()) environment.push_back("MODTRAN_DATA=" + runner.data.string());
    std::vector<std::string> arguments = {runner.executable.string()};
    if (input_file != "tape5") arguments.push_back(input_file);
    int status = 0;
    {
        const auto begin = Clock::now();
        Child child(runner.executable, arguments, environment, folder.path());
        for (auto nap = std::chrono::milliseconds(1); !child.ended(status);
             nap = std::min(2 * nap, std::chrono::milliseconds(50))) {
            if (Clock::now() - begin > runner.time_limit) {
                throw std::runtime_error(fmt::format(
                    "{}: stopped after {:.1f} s without an end", runner.executable.string(),
                    std::chrono::duration<double>(runner.time_limit).count()));
            }
            if (bytes_in(folder.path()) > runner.output_limit) {
                throw std::runtime_error(fmt::format("{}: stopped after writing more than {} bytes",
                                                     runner.executable.string(),
                                                     runner.output_limit));
            }
            std::this_thread::sleep_for(nap);
        }
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(
            fmt::format("{}: ended with {} {}", runner.executable.string(),
                        WIFEXITED(status) ? "code" : "signal",
                        WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)));
    }
    if (!fs::is_regular_file(fs::symlink_status(folder.path() / result_file))) {
        throw std::runtime_error(
            fmt::format("{}: left no file {}", runner.executable.string(), result_file));
    }
    return read_text(folder.path() / result_file, runner.output_limit);
}

std::vector<Tape7Run> run_decks(const ModtranRunner& runner,
                                const std::vector<ModtranDeck>& decks) {
    const std::string text = run_modtran(runner, "tape5", write_tape5(decks), "tape7");
    std::vector<Tape7Run> runs = read_tape7_text("tape7 of " + runner.executable.string(), text);
    if (runs.size() != decks.size()) {
        throw std::runtime_error(
            fmt::format("MODTRAN gave {} paths, {} were asked for", runs.size(), decks.size()));
    }
    return runs;
}

}  // namespace diurna
