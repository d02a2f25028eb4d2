#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/ground/rings.hpp"

namespace diurna {

/// Finds the ring that contains a point among many, in time about logarithmic in their number.
class RingIndex {
 public:
    /// Rings without corners contain nothing.
    explicit RingIndex(std::vector<Ring> rings);
    ~RingIndex();
    RingIndex(const RingIndex&) = delete;
    RingIndex& operator=(const RingIndex&) = delete;

    /// The last of the rings that contains() the point; −1: no ring. Thread-safe.
    std::int32_t last_around(const Eigen::Vector2d& p) const;

 private:
    struct Tree;
    std::vector<Ring> rings_;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace diurna
