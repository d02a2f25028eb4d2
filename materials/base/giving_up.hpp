#pragma once

#include <atomic>

namespace diurna {

/// Thrown out of work that its caller no longer wants. No std::exception: whoever catches errors to
/// tell of them, or to go on without what failed, lets it pass.
struct GivenUp {};

/// Set from any thread by whoever no longer wants the work.
using GiveUpRequest = std::atomic<bool>;

/// While it lives, work of this thread, and of the threads that help it (for_each_block), ends with
/// GivenUp soon after the request is set: before the next block of a loop. Requests nest; the
/// innermost counts.
class Heeding {
 public:
    /// - request: null: there is none; to outlive this
    explicit Heeding(const GiveUpRequest* request);
    ~Heeding();
    Heeding(const Heeding&) = delete;
    Heeding& operator=(const Heeding&) = delete;

    /// Of this thread; null where there is none.
    static const GiveUpRequest* heeded();

 private:
    const GiveUpRequest* before_;
};

/// Throws GivenUp where this thread's work is no longer wanted. For long loops that run on one
/// thread; costs a read or two.
void give_up_if_asked();

}  // namespace diurna
