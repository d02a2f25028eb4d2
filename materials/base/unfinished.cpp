#include "materials/base/unfinished.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "materials/base/unsynced_files.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// What a handler of signals may read: it can neither lock nor allocate.
struct Slot {
    enum State { free, taken, named, folder };
    std::atomic<int> state{free};
    std::array<char, PATH_MAX> path{};
};
std::array<Slot, 64> slots;
std::array<std::atomic<pid_t>, 64> child_groups{};
std::atomic<int> unsynced{0};  // UnsyncedFiles there are
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

/// −1 where all are taken, or the name is too long: then it only is not removed at a signal.
int remember(const fs::path& path, Slot::State kind = Slot::named) {
    const std::string name = fs::absolute(path).string();
    if (name.size() >= slots[0].path.size()) return -1;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        int state = Slot::free;
        if (!slots[i].state.compare_exchange_strong(state, Slot::taken)) continue;
        std::memcpy(slots[i].path.data(), name.c_str(), name.size() + 1);
        slots[i].state = kind;
        return static_cast<int>(i);
    }
    return -1;
}

void forget(int slot) {
    if (slot >= 0) slots[static_cast<std::size_t>(slot)].state = Slot::free;
}

/// A folder and the files in it, without the library's functions, which allocate.
void remove_folder(const char* path) {
    const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    alignas(dirent64) char block[4096];
    for (long bytes = 0; (bytes = ::syscall(SYS_getdents64, folder, block, sizeof block)) > 0;) {
        for (long at = 0; at < bytes;) {
            const auto* const entry = reinterpret_cast<const dirent64*>(block + at);
            ::unlinkat(folder, entry->d_name, 0);  // "." and ".." stay: they are folders
            at += entry->d_reclen;
        }
    }
    ::close(folder);
    ::rmdir(path);
}

void remove_unfinished() {
    for (const auto& group : child_groups) {
        if (const pid_t id = group; id > 0) ::kill(-id, SIGKILL);
    }
    for (const Slot& slot : slots) {
        if (slot.state == Slot::named) ::unlink(slot.path.data());
        if (slot.state == Slot::folder) remove_folder(slot.path.data());
    }
}

extern "C" void end_by_signal(int signal) {
    remove_unfinished();
    std::signal(signal, SIG_DFL);
    ::raise(signal);
}

}  // namespace

UnfinishedFile::UnfinishedFile(const fs::path& target)
    : target_(target), path_(temporary_beside(target)) {
    slot_ = remember(path_);
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (file_ >= 0) return;
    forget(slot_);
    throw std::runtime_error(target.string() + ": cannot create: " + std::strerror(errno));
}

UnfinishedFile::~UnfinishedFile() {
    if (file_ >= 0) ::close(file_);
    if (!path_.empty()) ::unlink(path_.c_str());
    forget(slot_);
}

void UnfinishedFile::fail(const char* what) const {
    throw std::runtime_error(target_.string() + ": " + what + ": " + std::strerror(errno));
}

void UnfinishedFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("cannot write");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void UnfinishedFile::rename() {
    if (::close(std::exchange(file_, -1)) != 0) fail("cannot close");
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("cannot rename into place");
    path_.clear();
}

void UnfinishedFile::finish() {
    if (unsynced > 0) {
        rename();
        return;
    }
    if (::fsync(file_) != 0) fail("cannot flush");
    rename();
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    const int entry = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (entry < 0) return;  // a folder that may be written into but not read
    ::fsync(entry);         // not every file system has it; the file itself is there and whole
    ::close(entry);
}

UnsyncedFiles::UnsyncedFiles(fs::path folder) : folder_(std::move(folder)) { ++unsynced; }

UnsyncedFiles::~UnsyncedFiles() {
    if (open_) --unsynced;
}

void UnsyncedFiles::sync() {
    if (!std::exchange(open_, false)) return;
    --unsynced;
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool flushed = folder >= 0 && ::syncfs(folder) == 0;
    const std::string reason = std::strerror(errno);
    if (folder >= 0) ::close(folder);
    if (!flushed) throw std::runtime_error(folder_.string() + ": cannot flush: " + reason);
}

fs::path temporary_beside(const fs::path& path) {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != sizeof random) {
        throw std::runtime_error(path.string() + ": found no free temporary name for it");
    }
    char tail[48];
    std::snprintf(tail, sizeof tail, ".%ld.%016llx.part", long(::getpid()),
                  static_cast<unsigned long long>(random));
    return path.parent_path() / fs::path(".").concat(path.filename().string()).concat(tail);
}

bool is_temporary_name(const std::string& name) {
    return name.starts_with(".") && name.ends_with(".part");
}

bool is_left_over(const fs::path& file) {
    const fs::path random = file.stem(), process = random.stem();  // ".NAME.PROCESS.RANDOM.part"
    if (!is_temporary_name(file.filename().string())) return false;
    const std::string number = process.extension().string();
    const long id = number.empty() ? 0 : std::strtol(number.c_str() + 1, nullptr, 10);
    return id > 0 && ::kill(pid_t(id), 0) != 0 && errno == ESRCH;
}

void end_at_once(std::string_view line) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    remove_unfinished();
    ::_exit(1);
}

void remove_unfinished_at_signals() {
    struct sigaction action {};
    action.sa_handler = end_by_signal;
    for (const int signal : ending_signals) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // nohup
    }
}

int end_with_program(pid_t group) {
    for (std::size_t i = 0; i < child_groups.size(); ++i) {
        pid_t none = 0;
        if (child_groups[i].compare_exchange_strong(none, group)) return static_cast<int>(i);
    }
    return -1;
}

void no_longer_end(int place) {
    if (place >= 0) child_groups[static_cast<std::size_t>(place)] = 0;
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
    std::string pattern = (fs::temp_directory_path() / (name + "-XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error(pattern + ": cannot create the folder: " + std::strerror(errno));
    }
    path_ = pattern;
    slot_ = remember(path_, Slot::folder);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    forget(slot_);
}

}  // namespace diurna
