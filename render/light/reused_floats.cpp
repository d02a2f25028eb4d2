#include "render/light/reused_floats.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace diurna {

namespace {

/// A few pieces of memory between frames.
struct Pool {
    static constexpr std::size_t most = 8;
    std::mutex mutex;
    std::vector<std::pair<std::size_t, ReusedFloats::Memory>> pieces;
};
ReusedFloats::Memory allocate(std::size_t size) {
    constexpr std::size_t page = std::size_t{2} << 20;
    const std::size_t bytes = (std::max<std::size_t>(size, 1) * sizeof(float) + 63) / 64 * 64;
    if (bytes < 4 * page) {
        return ReusedFloats::Memory(static_cast<float*>(std::aligned_alloc(64, bytes)));
    }
    const std::size_t whole = (bytes + page - 1) / page * page;
    auto* memory = static_cast<float*>(std::aligned_alloc(page, whole));
    if (memory != nullptr) madvise(memory, whole, MADV_HUGEPAGE);  // a wish; small pages do too
    return ReusedFloats::Memory(memory);
}

Pool& pool() {
    static Pool only;
    return only;
}

}  // namespace

ReusedFloats::ReusedFloats(std::size_t size) : size_(size) {
    {
        const std::lock_guard lock(pool().mutex);
        auto& pieces = pool().pieces;
        const auto fits = std::find_if(pieces.begin(), pieces.end(), [&](const auto& piece) {
            return piece.first >= size && piece.first / 2 <= size;
        });
        if (fits != pieces.end()) {
            size_ = fits->first;
            memory_ = std::move(fits->second);
            pieces.erase(fits);
        }
    }
    if (!memory_) memory_ = allocate(size);
    if (!memory_) throw std::bad_alloc();
}

ReusedFloats::~ReusedFloats() {
    const std::lock_guard lock(pool().mutex);
    auto& pieces = pool().pieces;
    if (pieces.size() >= Pool::most) pieces.erase(pieces.begin());
    pieces.emplace_back(size_, std::move(memory_));
}

}  // namespace diurna
