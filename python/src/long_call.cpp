#include "python/src/long_call.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "materials/base/giving_up.hpp"
#include "python/src/thread_limit.hpp"

namespace diurna::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds longest_wait{100};

struct StageShare {
    std::string stage;
    double share = 0.0;
};

/// Progress passed from the thread that works to the one that waits.
class ProgressQueue {
 public:
    void add(const std::string& stage, double share) {
        const std::lock_guard lock(mutex_);
        reported_.push_back({stage, share});
        changed_.notify_one();
    }
    void end() {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        changed_.notify_one();
    }
    /// Waits for at most a tenth of a second. Returns what was reported since the last call, and
    /// whether the work has ended.
    std::pair<std::vector<StageShare>, bool> wait() {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, longest_wait, [&] { return ended_ || !reported_.empty(); });
        return {std::exchange(reported_, {}), ended_};
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<StageShare> reported_;
    bool ended_ = false;
};

/// Calls `progress`, then the handlers of pending signals; throws what either raises.
void pass_on(const py::object& progress, const std::vector<StageShare>& reported) {
    if (!progress.is_none()) {
        for (const StageShare& one : reported) progress(one.stage, one.share);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void long_call(const py::object& progress, const std::function<void(const ProgressTo&)>& work) {
    const RunningCall running;
    ProgressQueue queue;
    GiveUpRequest stop{false};
    ProgressTo to;
    if (!progress.is_none()) {
        to = ProgressTo([&](const std::string& stage, double share) { queue.add(stage, share); });
    }
    std::exception_ptr thrown, raised;  // by the work; by Python
    std::thread worker([&] {
        const Heeding heeding(&stop);
        try {
            work(to);
        } catch (...) {
            thrown = std::current_exception();
        }
        queue.end();
    });
    for (bool ended = false; !ended;) {
        std::vector<StageShare> reported;
        {
            const py::gil_scoped_release free;
            std::tie(reported, ended) = queue.wait();
        }
        if (raised) continue;  // wait for the work to stop
        try {
            pass_on(progress, reported);
        } catch (...) {
            raised = std::current_exception();
            stop = true;
        }
    }
    {
        const py::gil_scoped_release free;
        worker.join();
    }
    if (raised) std::rethrow_exception(raised);
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace diurna::python
