#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "terrain/visibility/object_parts.hpp"

namespace diurna {

/// Boxes that overlap.
struct Overlaps {
    std::size_t pairs = 0;
    double deepest = 0.0;  // [m] smallest displacement to separate the worst pair
    std::pair<std::size_t, std::size_t> worst{};
};

/// All pairs of boxes that overlap by more than `least` [m]: with separating axes, along the sides
/// of both and vertical.
Overlaps overlaps(std::span<const BodyBox> boxes, double least);

}  // namespace diurna
