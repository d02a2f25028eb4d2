#pragma once

#include <atomic>

namespace diurna {

/// Thrown out of work that was cancelled. Not a std::exception: handlers that report errors, or
/// continue without the part that failed, must not catch it.
struct GivenUp {};

/// Set from any thread to cancel the work.
using GiveUpRequest = std::atomic<bool>;

/// While it exists, work of this thread, and of the threads that help it (for_each_block), ends
/// with GivenUp soon after the request is set: before the next block of a loop. Requests nest; the
/// innermost applies.
class Heeding {
 public:
    /// - request: null: no request; must outlive this object
    explicit Heeding(const GiveUpRequest* request);
    ~Heeding();
    Heeding(const Heeding&) = delete;
    Heeding& operator=(const Heeding&) = delete;

    /// The request of this thread; null without one.
    static const GiveUpRequest* heeded();

 private:
    const GiveUpRequest* before_;
};

/// Throws GivenUp if this thread's work was cancelled. For long loops on one thread; takes one or
/// two memory reads.
void give_up_if_asked();

}  // namespace diurna
