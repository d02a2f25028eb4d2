#include "materials/base/giving_up.hpp"

#include <utility>

namespace diurna {

namespace {
thread_local const GiveUpRequest* of_this_thread = nullptr;
}

Heeding::Heeding(const GiveUpRequest* request) : before_(std::exchange(of_this_thread, request)) {}

Heeding::~Heeding() { of_this_thread = before_; }

const GiveUpRequest* Heeding::heeded() { return of_this_thread; }

void give_up_if_asked() {
    if (of_this_thread != nullptr && of_this_thread->load(std::memory_order_relaxed)) {
        throw GivenUp{};
    }
}

}  // namespace diurna
