#pragma once

#include <cstddef>
#include <functional>

namespace diurna {

/// Limits the number of worker threads for the rest of the process; 0 means one per core.
void set_thread_count(int threads);
int thread_count();

/// Calls body(begin, end) over [0, count) in blocks of `grain`, in any order and on any thread. The
/// blocks are the same whatever the number of threads, so a body that writes only its own block's
/// results gives the same bytes. An exception from a body reaches the caller.
void for_each_block(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for each i in [0, count).
template <class Body>
void for_each_index(std::size_t count, const Body& body, std::size_t grain = 256) {
    for_each_block(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

}  // namespace diurna
