#include "materials/modtran/run.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "materials/base/child_process.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/unfinished.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

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

ChildProcess started(const ModtranRunner& runner, const std::vector<std::string>& environment,
                     const fs::path& folder) {
    try {
        return ChildProcess(
            {.words = {runner.executable.string()}, .environment = environment, .folder = folder});
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("{}: cannot be started: {}",
                                             runner.executable.string(), error.code().message()));
    }
}

/// Runs the program in a folder until it ends, and returns its status; throws where it takes longer
/// or writes more than allowed.
int wait_for(const ModtranRunner& runner, const std::vector<std::string>& environment,
             const fs::path& folder) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::string name = runner.executable.string();
    ChildProcess child = started(runner, environment, folder);
    int status = 0;
    for (auto nap = std::chrono::milliseconds(1); !child.ended(status);
         nap = std::min(2 * nap, std::chrono::milliseconds(50))) {
        if (Clock::now() - begin > runner.time_limit) {
            throw std::runtime_error(
                fmt::format("{}: stopped after {:.1f} s without a result", name,
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
    const TemporaryFolder folder("diurna-modtran");
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
        throw std::runtime_error(
            fmt::format("{}: wrote no file tape7", runner.executable.string()));
    }
    return read_text(tape7, runner.output_limit);
}

std::vector<Tape7Run> run_decks(const ModtranRunner& runner,
                                const std::vector<ModtranDeck>& decks) {
    const std::string text = run_modtran(runner, write_tape5(decks));
    std::vector<Tape7Run> runs = read_tape7_text("tape7 of " + runner.executable.string(), text);
    if (runs.size() != decks.size()) {
        throw std::runtime_error(
            fmt::format("MODTRAN computed {} paths, expected {}", runs.size(), decks.size()));
    }
    return runs;
}

}  // namespace diurna
