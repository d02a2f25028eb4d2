// Loaded before the C library (LD_PRELOAD), so that one call of a program fails as it would on a
// full disk, without memory, or where the system gives no more threads.
//
//     FAULT_KIND   write, read, malloc, thread; kill: the process is killed half way in a write
//     FAULT_AT     which call of that kind fails, from 1; 0: none
//     FAULT_ON     1: and all after it
//     FAULT_COUNT  a file that is given the number of calls at the end
//
// Of reads and writes those of regular files count, and of writes those to stdout, but none to
// stderr. A read that fails is a short one: half of what was asked for.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind { none, writing, killing, reading, allocating, starting };

Kind chosen = none;
long fails_at = 0;
bool goes_on = false;
std::atomic<long> calls{0};
std::atomic<bool> ready{false};
thread_local bool spared = false;

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

bool fails(Kind kind) {
    if (!ready || kind != chosen) return false;
    const long call = ++calls;
    return fails_at > 0 && (call == fails_at || (goes_on && call > fails_at));
}

bool is_file(int file) {
    struct stat is {};
    return ::fstat(file, &is) == 0 && S_ISREG(is.st_mode);
}
bool write_fails(int file, const void* bytes = nullptr, std::size_t count = 0) {
    if (chosen != writing && chosen != killing) return false;
    if (file == 2 || (file != 1 && !is_file(file)) || !fails(chosen)) return false;
    if (chosen == killing) {
        ::syscall(SYS_write, file, bytes, count / 2);
        ::raise(SIGKILL);
    }
    errno = ENOSPC;
    return true;
}
bool read_is_short(int file) { return chosen == reading && is_file(file) && fails(reading); }
std::size_t half(std::size_t size) { return size > 1 ? size / 2 : size; }

bool none_left() {
    if (spared || !fails(allocating)) return false;
    errno = ENOMEM;
    return true;
}

__attribute__((constructor)) void begin() {
    const char* kind = std::getenv("FAULT_KIND");
    const char* at = std::getenv("FAULT_AT");
    const char* on = std::getenv("FAULT_ON");
    if (kind == nullptr) return;
    if (std::strcmp(kind, "write") == 0) chosen = writing;
    if (std::strcmp(kind, "kill") == 0) chosen = killing;
    if (std::strcmp(kind, "read") == 0) chosen = reading;
    if (std::strcmp(kind, "malloc") == 0) chosen = allocating;
    if (std::strcmp(kind, "thread") == 0) chosen = starting;
    fails_at = at == nullptr ? 0 : std::atol(at);
    goes_on = on != nullptr && *on == '1';
    ready = true;
}

__attribute__((destructor)) void end() {
    ready = false;
    const char* path = std::getenv("FAULT_COUNT");
    if (path == nullptr) return;
    char text[32];
    const int length = std::snprintf(text, sizeof text, "%ld\n", calls.load());
    const int file = ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0) return;
    ::syscall(SYS_write, file, text, std::size_t(length));
    ::close(file);
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
    return write_fails(file, bytes, count) ? -1 : real(file, bytes, count);
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
    return write_fails(file) ? -1 : real(file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off_t at) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite64");
    return write_fails(file) ? -1 : real(file, bytes, count, at);
}
ssize_t writev(int file, const iovec* parts, int count) {
    static const auto real = next<ssize_t (*)(int, const iovec*, int)>("writev");
    return write_fails(file) ? -1 : real(file, parts, count);
}
int fsync(int file) {
    static const auto real = next<int (*)(int)>("fsync");
    return write_fails(file) ? -1 : real(file);
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
    static const auto real = next<size_t (*)(const void*, size_t, size_t, FILE*)>("fwrite");
    // As where a buffer could not be put out: the stream remembers, and what follows is lost too.
    if (write_fails(::fileno(file))) {
        file->_flags |= 0x20;  // _IO_ERR_SEEN of glibc, which has no call for it
        return 0;
    }
    return real(bytes, size, count, file);
}
int rename(const char* from, const char* to) {
    static const auto real = next<int (*)(const char*, const char*)>("rename");
    return write_fails(1) ? -1 : real(from, to);
}

ssize_t read(int file, void* bytes, size_t count) {
    static const auto real = next<ssize_t (*)(int, void*, size_t)>("read");
    return real(file, bytes, read_is_short(file) ? half(count) : count);
}
ssize_t pread(int file, void* bytes, size_t count, off_t at) {
    static const auto real = next<ssize_t (*)(int, void*, size_t, off_t)>("pread");
    return real(file, bytes, read_is_short(file) ? half(count) : count, at);
}
ssize_t pread64(int file, void* bytes, size_t count, off_t at) {
    static const auto real = next<ssize_t (*)(int, void*, size_t, off_t)>("pread64");
    return real(file, bytes, read_is_short(file) ? half(count) : count, at);
}
size_t fread(void* bytes, size_t size, size_t count, FILE* file) {
    static const auto real = next<size_t (*)(void*, size_t, size_t, FILE*)>("fread");
    if (!read_is_short(::fileno(file))) return real(bytes, size, count, file);
    file->_flags |= 0x20;
    return real(bytes, size, half(count), file);
}

/// Not tried: where memory fails while HDF5 1.10 sets itself up, it calls itself until the stack is
/// full (H5E_printf_stack by H5I_inc_ref by H5E__push_stack).
int H5open() {
    static const auto real = next<int (*)()>("H5open");
    spared = true;
    const int status = real();
    spared = false;
    return status;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                   void* given) {
    static const auto real =
        next<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
    return fails(starting) ? EAGAIN : real(thread, attributes, body, given);
}

void* malloc(size_t size) { return none_left() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
    return none_left() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) { return none_left() ? nullptr : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) {
    return none_left() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
    return none_left() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** result, size_t alignment, size_t size) {
    if (none_left()) return ENOMEM;
    *result = __libc_memalign(alignment, size);
    return *result == nullptr ? ENOMEM : 0;
}
}
