#pragma once

#include <optional>

#include "materials/base/section.hpp"

namespace diurna {

/// Reference of a height: the ground below, the sea (at the level given by terrain.vertical_datum),
/// or the ellipsoid of WGS84.
enum class HeightOver { ground, sea, ellipsoid };

/// Height of an object or eye at a place.
struct HeightInput {
    double metres = 0.0;
    HeightOver over = HeightOver::ground;
};

/// height_above_ground_m, height_above_sea_m or height_above_ellipsoid_m: one of the three.
///
/// - says: "of its eye"
/// - fallback: above the ground, if none is given; without one that is a mistake
/// - above_ground: allowed range of the first
HeightInput read_height(const Section& section, const char* says, std::optional<double> fallback,
                        Range above_ground);

/// The key by which it was given, or the first one if none was.
const char* height_key(const Section& section);

/// Reports every such key as a mistake, for things whose height is given in another way.
void refuse_heights(const Section& section, const char* problem);

}  // namespace diurna
