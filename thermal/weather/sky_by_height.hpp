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
/// - direct: times the clear sky's there over the clear sky's at the station: less air (pressure)
///   and water above. Aerosol is left as it is: where haze is thick and shallow, heights get less
///   sun than they have.
/// - diffuse: likewise; under cloud it follows the clear sky's global light instead
/// - above the top of a scene's cloud, and sunlight in thick haze: the scene's air's
///   (light_by_height.hpp), so that above the cloud there is the clear sky that pictures have
/// - albedo and what was measured on a facet's plane stay.
///
/// now    the station's weather, with its cloud inferred if not observed (SkySeries::weather)
/// there  air_at_height of its air
SkyState sky_at_height(const SkyState& sky, const Forcing& now, const AirState& there,
                       const AirByHeight& rule, double height, const ClearSky& clear);

}  // namespace diurna
