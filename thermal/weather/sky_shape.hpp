#pragma once

#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

// Distribution of a sky's longwave and scattered sunlight, in
// terrain/visibility/sky_basis.hpp's functions. A facet is described by its shares of those
// (sky_of, plane_behind_ring).

/// Longwave of a facet from its visible sky minus its sky view times the horizontal flux, per σT⁴
/// of the air. The clear sky's emissivity grows towards the horizon as
/// ε(z) = ε + b (ln sec z − ½), b = 0.09 (Unsworth & Monteith 1975, Q. J. R. Meteorol. Soc. 101,
/// 13). Zero for a level facet under the whole sky, ½ b ln 2 = 0.031 for a wall (12 W/m²).
inline double tilted_sky_excess(const SkyVector& sky) {
    return 0.09 * (double{sky[3]} - 0.5 * double{sky[0]});
}

/// Distribution of a sky's scattered sunlight, as shares of that on the horizontal: the circumsolar
/// part, the excess on a wall due to a brighter (darker: negative) horizon, and coefficients of sky
/// functions relative to a uniform sky.
struct DiffuseSplit {
    double circumsolar = 0.0;  // 0 to 1, on the horizontal
    double horizon = 0.0;
    SkyVector uneven{};   // Σ uneven_k T_k is 0 on open level ground
    bool by_air = false;  // from a scene's air (sky_spread.hpp), else from perez_split()
};
/// By Perez and others (1990, Solar Energy 44, 271), in the continuous form of Driesse and others
/// (2024, Solar Energy 267). Zero if the sun is down.
///
/// - direct_normal, diffuse: [W m⁻²]
/// - top: sunlight above the air, facing the sun [W m⁻²]
DiffuseSplit perez_split(double direct_normal, double diffuse, double zenith_deg, double top);

/// A facet's view of the horizon's brightness, relative to that of a wall. The model treats it as a
/// line: sin(slope) of an open plane. Here it extends over 15° above the horizon, so that obstacles
/// hide it: 0 on level ground, 1 on a wall, within 0.02 of that sine between.
double horizon_view(const SkyVector& sky);

}  // namespace diurna
