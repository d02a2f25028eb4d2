#include "render/scratch.hpp"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace diurna {

namespace {

/// A few pieces of memory between frames.
struct Pool {
    static constexpr std::size_t most = 8;
    std::mutex mutex;
    std::vector<std::pair<std::size_t, std::unique_ptr<float[]>>> pieces;
};
Pool& pool() {
    static Pool only;
    return only;
}

}  // namespace

Scratch::Scratch(std::size_t size) : size_(size) {
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
    if (!memory_) memory_ = std::make_unique_for_overwrite<float[]>(size);
}

Scratch::~Scratch() {
    const std::lock_guard lock(pool().mutex);
    auto& pieces = pool().pieces;
    if (pieces.size() >= Pool::most) pieces.erase(pieces.begin());
    pieces.emplace_back(size_, std::move(memory_));
}

}  // namespace diurna
