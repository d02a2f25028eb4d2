#pragma once

#include <optional>

#include "materials/base/section.hpp"

namespace diurna {

/// What a height is counted from: the ground below, the sea (of which terrain.vertical_datum says
/// where it is), or the ellipsoid of WGS84.
enum class HeightOver { ground, sea, ellipsoid };

/// Height of something that stands or hangs at a place.
struct HeightInput {
    double metres = 0.0;
    HeightOver over = HeightOver::ground;
};

/// height_above_ground_m, height_above_sea_m or height_above_ellipsoid_m: one of the three.
///
/// - says: "of its eye"
/// - fallback: above the ground, where none is given; without one that is a mistake
/// - above_ground: what the first may be
HeightInput read_height(const Section& section, const char* says, std::optional<double> fallback,
                        Range above_ground);

/// The key by which it was given, or the first where none was.
const char* height_key(const Section& section);

/// Tells of every such key as a mistake, of something whose height is said otherwise.
void refuse_heights(const Section& section, const char* problem);

}  // namespace diurna
