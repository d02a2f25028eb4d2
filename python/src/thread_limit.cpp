#include "python/src/thread_limit.hpp"

#include <fmt/format.h>

#include <mutex>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"

namespace diurna::python {

namespace {

struct Limit {
    std::mutex guard;
    int running = 0;           // calls that compute now
    int threads = 0;           // of set_threads()
    bool of_one_call = false;  // the number in force is that of a ThreadsOfCall
    bool restore = false;      // once no call is running
};

Limit& limit() {
    static Limit only;
    return only;
}

/// With the guard held.
void change(Limit& held, int threads) {
    if (held.running > 0 || held.of_one_call) {
        throw InputError("threads", "another call of diurna is running",
                         "set the number of threads before that call, or wait for its end");
    }
    set_thread_count(threads);
}

/// With the guard held.
void restore_if_idle(Limit& held) {
    if (!held.restore || held.running > 0) return;
    set_thread_count(held.threads);
    held.restore = held.of_one_call = false;
}

}  // namespace

RunningCall::RunningCall() {
    const std::lock_guard lock(limit().guard);
    ++limit().running;
}

RunningCall::~RunningCall() {
    const std::lock_guard lock(limit().guard);
    --limit().running;
    restore_if_idle(limit());
}

void set_threads(int threads) {
    if (threads < 0) {
        throw InputError("threads", fmt::format("found {}", threads),
                         "expected 0 (one for each core) or more");
    }
    const std::lock_guard lock(limit().guard);
    change(limit(), threads);
    limit().threads = threads;
}

ThreadsOfCall::ThreadsOfCall(int threads) : changed_(threads >= 0) {
    if (!changed_) return;
    const std::lock_guard lock(limit().guard);
    change(limit(), threads);
    limit().of_one_call = true;
}

ThreadsOfCall::~ThreadsOfCall() {
    if (!changed_) return;
    const std::lock_guard lock(limit().guard);
    limit().restore = true;
    restore_if_idle(limit());
}

}  // namespace diurna::python
