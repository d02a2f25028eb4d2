#pragma once

#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Instants, ascending, to the nearest second, at which the sun's centre passes an azimuth
/// (clockwise from true north) while it is above the horizon, geometrically.
///
/// - from, to: range of the instants
std::vector<Instant> sun_at_azimuth(const Site& site, Instant from, Instant to, double azimuth_deg);

enum class DayHalf { morning, afternoon, both };  // while the sun rises, and while it sets

/// The same for an elevation, without refraction.
std::vector<Instant> sun_at_elevation(const Site& site, Instant from, Instant to,
                                      double elevation_deg, DayHalf half);

}  // namespace diurna
