#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "terrain/visibility/object_parts.hpp"

namespace diurna {

/// Boxes that reach into one another.
struct Overlaps {
    std::size_t pairs = 0;
    double deepest =
        0.0;  // [m] by which the worst would have to be moved apart, in plan or upright
    std::pair<std::size_t, std::size_t> worst{};
};

/// Of all pairs of boxes, those that overlap by more than `least` [m]: with separating axes, along
/// the sides of both and upright.
Overlaps overlaps(std::span<const BodyBox> boxes, double least);

}  // namespace diurna
