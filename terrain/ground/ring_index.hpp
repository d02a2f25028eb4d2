#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/ground/rings.hpp"

namespace diurna {

/// Which of many rings holds a point, in about the logarithm of their number.
class RingIndex {
 public:
    /// Rings of no corners hold nothing.
    explicit RingIndex(std::vector<Ring> rings);
    ~RingIndex();
    RingIndex(const RingIndex&) = delete;
    RingIndex& operator=(const RingIndex&) = delete;

    /// The last of the rings that contains() the point; -1: none does. Safe from many threads.
    std::int32_t last_around(const Eigen::Vector2d& p) const;

 private:
    struct Tree;
    std::vector<Ring> rings_;
    std::unique_ptr<const Tree> tree_;
};

}  // namespace diurna
