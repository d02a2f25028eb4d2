#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/corpus/yard.hpp"
#include "tests/support/differing.hpp"
#include "tests/support/scratch_folder.hpp"

/// Runs of the corpus's yard in which a call of the system fails (tests/faults/fault_shim.cpp) or
/// that are killed, and what a run that nothing befell leaves in its folder.
namespace faults {

namespace fs = std::filesystem;
using Environment = std::map<std::string, std::string>;
using Contents = std::map<std::string, std::string>;

struct Ended {
    int code = -1, signal = 0;
    std::vector<std::string> lines{};  // on stderr, without notes and GDAL's own last words
};

inline std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A call that fails: see fault_shim.cpp. "kill" kills in the middle of a write.
inline Environment failing(const std::string& kind, long at, bool on = false) {
    return {{"LD_PRELOAD", DIURNA_FAULT_SHIM},
            {"FAULT_KIND", kind},
            {"FAULT_AT", std::to_string(at)},
            {"FAULT_ON", on ? "1" : "0"}};
}

/// Everything a run leaves but its page and manifest, which tell seconds.
inline Contents contents(const fs::path& folder) {
    Contents found;
    if (!fs::exists(folder)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (!entry.is_regular_file() || name == "report.html" || name == "manifest.json") continue;
        found[name] = text_of(entry.path());
    }
    return found;
}

/// A scene in a folder of its own, and where its runs keep what they may keep.
class Stage {
 public:
    explicit Stage(const std::string& name) : scratch_(name) {
        for (const auto& [file, text] : yard::files()) {
            std::ofstream(scratch_.path / file, std::ios::binary) << text;
        }
        std::ofstream(scratch_.path / "scene.toml", std::ios::app) << "[output]\nstate = true\n";
    }
    fs::path out() const { return scratch_.path / "out"; }
    /// Of what runs have found, for others.
    fs::path store() const { return scratch_.path / "store"; }
    /// As before the first run.
    void begin_anew() const {
        fs::remove_all(out());
        fs::remove_all(store());
    }

    /// - seconds: after which it is sent the signal; 0: never
    Ended diurna(const std::vector<std::string>& words, const Environment& environment = {},
                 double seconds = 0.0, int signal = SIGKILL) const {
        const fs::path reported = scratch_.path / "stderr";
        const pid_t child = ::fork();
        if (child < 0) throw std::runtime_error("cannot fork");
        if (child == 0) become(words, environment, reported);
        if (seconds > 0.0) {
            ::usleep(static_cast<useconds_t>(1e6 * seconds));
            ::kill(child, signal);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        Ended ended;
        if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
        std::istringstream lines(text_of(reported));
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("note:") && !line.starts_with("FATAL: CPL"))
                ended.lines.push_back(line);
        }
        return ended;
    }
    Ended run(const Environment& environment = {}, double seconds = 0.0,
              int signal = SIGKILL) const {
        return diurna({"run", "scene.toml", "--out", "out", "--progress", "none", "--resume"},
                      environment, seconds, signal);
    }
    /// How many calls of a kind an undisturbed run makes into an empty folder.
    long calls(const std::string& kind) const {
        Environment counted = failing(kind, 0);
        counted["FAULT_COUNT"] = (scratch_.path / "count").string();
        begin_anew();
        if (run(counted).code != 0) throw std::runtime_error("the yard does not run");
        return std::stol(text_of(scratch_.path / "count"));
    }

 private:
    [[noreturn]] void become(const std::vector<std::string>& words, const Environment& environment,
                             const fs::path& reported) const {
        std::vector<const char*> argv{DIURNA_BINARY};
        for (const std::string& word : words) argv.push_back(word.c_str());
        argv.push_back(nullptr);
        const int err = ::open(reported.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int out = ::open("/dev/null", O_WRONLY);
        if (::chdir(scratch_.path.c_str()) != 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) {
            ::_exit(99);
        }
        ::setenv("DIURNA_STAGES", store().c_str(), 1);
        for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
        ::execv(argv[0], const_cast<char* const*>(argv.data()));
        ::_exit(98);
    }
    ScratchFolder scratch_;
};

/// Of files that stand there, those that are not to the byte what the whole run leaves; the ledger
/// grows line by line.
inline std::vector<std::string> torn(const Contents& found, const Contents& whole) {
    std::vector<std::string> names;
    for (const auto& [name, text] : found) {
        if (name == "ledger.jsonl") continue;
        if (!whole.contains(name) || whole.at(name) != text) names.push_back(name);
    }
    return names;
}

}  // namespace faults
