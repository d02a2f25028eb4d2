#pragma once

#include "materials/air/air_by_height.hpp"
#include "thermal/weather/sky_state.hpp"

namespace diurna {

/// Converts the sky of a station to another height [m] above the sea.
///
/// - longwave: its formula with the air at that height, under the same cloud; a measured value
///   keeps
///   its ratio to the formula. Decreases by some 3 W m⁻² per 100 m (Marty et al. 2002, Theor.
///   Appl.
///   Climatol. 72, 137, measured 2.9 in the Alps; tests/thermal/sky_by_height_test.cpp)
/// - direct: times the ratio of the clear sky's there and at the station: less air (pressure) and
///   water above. Aerosol is not changed: above thick, shallow haze the computed sun is too weak.
/// - diffuse: the same; under cloud with the ratio of the clear sky's global light instead
/// - albedo and values measured on a facet's plane are unchanged.
///
/// now    the station's weather, with its cloud inferred if not observed (SkySeries::weather)
/// there  air_at_height of its air
SkyState sky_at_height(const SkyState& sky, const Forcing& now, const AirState& there,
                       const AirByHeight& rule, double height, const ClearSky& clear);

}  // namespace diurna
