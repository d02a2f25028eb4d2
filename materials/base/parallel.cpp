#include "materials/base/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>

#include "materials/base/giving_up.hpp"

namespace diurna {

namespace {

/// The limit holds for everyone who uses TBB, Embree's builder included. The arena is our own,
/// because the one that TBB makes for a thread keeps the size it had at first use.
struct Workers {
    std::unique_ptr<tbb::global_control> limit;
    std::unique_ptr<tbb::task_arena> arena = std::make_unique<tbb::task_arena>();
};

Workers& workers() {
    static Workers only;
    return only;
}

}  // namespace

void set_thread_count(int threads) {
    Workers& w = workers();
    w.limit.reset();
    if (threads > 0) {
        w.limit = std::make_unique<tbb::global_control>(
            tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }
    w.arena =
        std::make_unique<tbb::task_arena>(threads > 0 ? threads : +tbb::task_arena::automatic);
}

int thread_count() {
    const auto allowed =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::max(1, static_cast<int>(allowed));
}

void for_each_block(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& body) {
    grain = std::max<std::size_t>(1, grain);
    const std::size_t blocks = (count + grain - 1) / grain;
    const GiveUpRequest* const request = Heeding::heeded();  // of whoever calls
    workers().arena->execute([&] {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            const Heeding heeding(request);
            give_up_if_asked();
            body(block * grain, std::min(count, (block + 1) * grain));
        });
    });
}

}  // namespace diurna
