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

namespace diurna::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds between_looks{100};

struct Messages {
    std::string stage;
    double share = 0.0;
};

/// What the thread that works and the one that waits say to each other.
class Desk {
 public:
    void tell(const std::string& stage, double share) {
        const std::lock_guard lock(mutex_);
        reported_.push_back({stage, share});
        changed_.notify_one();
    }
    void end() {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        changed_.notify_one();
    }
    /// Waits a little; what was reported since, and whether the work has ended.
    std::pair<std::vector<Messages>, bool> wait() {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, between_looks, [&] { return ended_ || !reported_.empty(); });
        return {std::exchange(reported_, {}), ended_};
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Messages> reported_;
    bool ended_ = false;
};

/// Throws what a signal's handler or `progress` raises.
void look(const py::object& progress, const std::vector<Messages>& reported) {
    if (!progress.is_none()) {
        for (const Messages& one : reported) progress(one.stage, one.share);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void long_call(const py::object& progress, const std::function<void(const ProgressTo&)>& work) {
    Desk desk;
    GiveUpRequest unwanted{false};
    ProgressTo to;
    if (!progress.is_none()) {
        to = ProgressTo([&](const std::string& stage, double share) { desk.tell(stage, share); });
    }
    std::exception_ptr thrown, raised;  // by the work; by Python
    std::thread worker([&] {
        const Heeding heeding(&unwanted);
        try {
            work(to);
        } catch (...) {
            thrown = std::current_exception();
        }
        desk.end();
    });
    for (bool ended = false; !ended;) {
        std::vector<Messages> reported;
        {
            const py::gil_scoped_release free;
            std::tie(reported, ended) = desk.wait();
        }
        if (raised) continue;  // until the work has ended
        try {
            look(progress, reported);
        } catch (...) {
            raised = std::current_exception();
            unwanted = true;
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
