#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/corpus/yard.hpp"
#include "tests/support/scratch_folder.hpp"

/// Malformed inputs, each given to a process of its own.
namespace corpus {

/// An input that cannot be used: files beside those of the yard, or in their place, and the words
/// after `diurna`.
struct Malformed {
    std::string name;
    std::map<std::string, std::string> files;
    std::vector<std::string> words{"check", "scene.toml"};
};
using Family = std::vector<Malformed>;

constexpr double most_seconds = 20.0;
constexpr double most_bytes = 1e9;  // or four times the files
constexpr std::size_t most_lines = 21;
// Under sanitizers, which need address space, memory and time of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_watched = true;
#else
constexpr bool is_watched = false;
#endif

/// `text` with the first `from` put as `to`.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the yard has no " + from);
    return text.replace(at, from.size(), to);
}

/// The yard's scene with one thing changed.
inline Malformed scene(const std::string& name, const std::string& from, const std::string& to) {
    return {.name = name, .files = {{"scene.toml", changed(yard::scene, from, to)}}};
}

struct Ended {
    int code = -1, signal = 0;
    bool late = false;
    double seconds = 0.0, peak_bytes = 0.0;
    std::string reported;  // on stderr
};

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs the program in a folder with an end to its time and its address space.
inline Ended run(const std::filesystem::path& folder, const std::vector<std::string>& words) {
    const std::filesystem::path reported = folder.string() + ".stderr";
    std::vector<const char*> argv{DIURNA_BINARY};
    for (const std::string& word : words) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    const auto begun = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
        const rlimit space{rlim_t(6e9), rlim_t(6e9)}, core{0, 0};
        if (!is_watched) ::setrlimit(RLIMIT_AS, &space);
        ::setrlimit(RLIMIT_CORE, &core);
        const int err = ::open(reported.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int out = ::open("/dev/null", O_WRONLY);
        if (::chdir(folder.c_str()) != 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(99);
        ::execv(argv[0], const_cast<char* const*>(argv.data()));
        ::_exit(98);
    }
    Ended ended;
    int status = 0;
    rusage used{};
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    };
    while (::wait4(child, &status, WNOHANG, &used) == 0) {
        if (!ended.late && seconds() > (is_watched ? 20.0 : 1.0) * most_seconds) {
            ended.late = true;
            ::kill(child, SIGKILL);
        }
        ::usleep(2000);
    }
    ended.seconds = seconds();
    ended.peak_bytes = 1024.0 * double(used.ru_maxrss);
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
    ended.reported = text_of(reported);
    std::filesystem::remove(reported);
    return ended;
}

/// Every file of a folder, those in its folders too.
inline std::set<std::string> files_of(const std::filesystem::path& folder) {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        found.insert(entry.path().string());
    }
    return found;
}

inline double put_files(const std::filesystem::path& folder,
                        const std::map<std::string, std::string>& more) {
    std::map<std::string, std::string> files = yard::files();
    for (const auto& [name, text] : more) files[name] = text;
    double bytes = 0.0;
    std::filesystem::create_directories(folder);
    for (const auto& [name, text] : files) {
        std::ofstream(folder / name, std::ios::binary) << text;
        bytes += double(text.size());
    }
    return bytes;
}

/// What is wrong with how a case ended; "" where it was refused as it should be.
inline std::string fault_of(const Ended& ended, double bytes, bool wrote, const Malformed& given,
                            const std::filesystem::path& folder) {
    if (ended.late) return "late";
    if (ended.signal != 0) return fmt::format("crashed, signal {}", ended.signal);
    if (!is_watched && ended.peak_bytes > std::max(most_bytes, 4.0 * bytes)) {
        return fmt::format("memory, {:.2f} GB", ended.peak_bytes / 1e9);
    }
    if (ended.code == 0) return "accepted";
    if (ended.code != 2) return fmt::format("left with {}", ended.code);
    if (wrote) return "wrote";
    const auto lines = std::size_t(std::count(ended.reported.begin(), ended.reported.end(), '\n'));
    const std::string first = ended.reported.substr(0, ended.reported.find('\n'));
    bool named = first.find("--") != std::string::npos;
    for (const std::string& file : files_of(folder)) {
        const std::string name = std::filesystem::path(file).filename().string();
        named = named || first.find(name) != std::string::npos;
    }
    for (const std::string& word : given.words) {
        named = named || first.find(word) != std::string::npos;
    }
    if (!named || lines == 0 || lines > most_lines || first.size() > 4000) return "told badly";
    return "";
}

/// Gives each case to a process of its own, two at a time, and prints how many ended how. Returned
/// is a line for each that was not refused as it should be: with exit code 2, in lines whose first
/// names a file or an option, 21 of them at the most, within 20 s and 1 GB (or four times its
/// files), and nothing written.
inline std::vector<std::string> not_refused(const std::string& family, const Family& cases) {
    const ScratchFolder scratch("corpus-" + family);
    std::vector<std::string> faults(cases.size());
    std::atomic<std::size_t> next = 0;
    double most = 0.0, longest = 0.0;
    std::mutex sums;
    const auto work = [&] {
        for (std::size_t i = next++; i < cases.size(); i = next++) {
            const Malformed& given = cases[i];
            const std::filesystem::path folder = scratch.path / std::to_string(i);
            const double bytes = put_files(folder, given.files);
            const std::set<std::string> before = files_of(folder);
            const Ended ended = run(folder, given.words);
            const std::string fault =
                fault_of(ended, bytes, files_of(folder) != before, given, folder);
            if (!fault.empty() || std::getenv("CORPUS_ALL") != nullptr) {
                faults[i] = fmt::format("{}: {}: {:.1f} s: {}", given.name, fault, ended.seconds,
                                        ended.reported.substr(0, 300));
            }
            std::filesystem::remove_all(folder);
            const std::lock_guard guard(sums);
            most = std::max(most, ended.peak_bytes);
            longest = std::max(longest, ended.seconds);
        }
    };
    std::thread other(work);
    work();
    other.join();
    std::vector<std::string> found;
    for (const std::string& fault : faults) {
        if (!fault.empty()) found.push_back(fault);
    }
    fmt::print("{:<12} {:4} cases, {:4} refused, {:3} not; at most {:.2f} GB, {:.1f} s\n", family,
               cases.size(), cases.size() - found.size(), found.size(), most / 1e9, longest);
    return found;
}

/// Fails with a line for each that was not refused so.
inline void no_fault(const std::string& family, const Family& cases) {
    for (const std::string& fault : not_refused(family, cases)) FAIL_CHECK(fault);
}

}  // namespace corpus
