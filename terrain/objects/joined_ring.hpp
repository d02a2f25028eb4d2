#pragma once

#include <optional>
#include <span>

#include "terrain/ground/rings.hpp"

namespace diurna {

/// A ring and its holes as one ring, which goes to each hole and back along a bridge: what
/// cut_polygon() takes. Bridges are the shortest that meet no side of the ring or of a hole.
///
/// ring     counterclockwise
/// holes    clockwise, inside the ring, beside each other
/// returns  none where no bridge leads to a hole: it lies outside
///
/// Takes the square of the number of corners, times the holes.
std::optional<Ring> joined_ring(const Ring& ring, std::span<const Ring> holes);

}  // namespace diurna
