#include "terrain/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>

namespace diurna {

namespace {
std::unique_ptr<tbb::global_control> limit;
}

void set_thread_count(int threads) {
    limit.reset();
    if (threads > 0) {
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
    }
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
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        body(block * grain, std::min(count, (block + 1) * grain));
    });
}

}  // namespace diurna
