#pragma once

#include <optional>
#include <span>

#include "terrain/ground/rings.hpp"

namespace diurna {

/// A ring and its holes as one ring, which visits each hole along a bridge and returns: input for
/// cut_polygon(). Bridges are the shortest that cross no side of the ring or of a hole.
///
/// ring     counterclockwise
/// holes    clockwise, inside the ring, not overlapping
/// returns  nullopt if no bridge leads to a hole: it is outside
///
/// Time grows with the square of the number of corners, times the holes.
std::optional<Ring> joined_ring(const Ring& ring, std::span<const Ring> holes);

}  // namespace diurna
