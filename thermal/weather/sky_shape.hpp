#pragma once

#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

// How a sky's heat and scattered sunlight are spread over it, in the functions of
// terrain/visibility/sky_basis.hpp. A facet is its shares of those (sky_of, plane_behind_ring).

/// What a facet receives from the part of the sky it sees, beyond its sky view times the
/// horizontal's flux, per σT⁴ of the air. The clear sky's emissivity grows towards the horizon as
/// ε(z) = ε + b (ln sec z − ½), b = 0.09 (Unsworth & Monteith 1975, Q. J. R. Meteorol. Soc. 101,
/// 13). Zero for a level facet under the whole sky, ½ b ln 2 = 0.031 for a wall (12 W/m²).
inline double tilted_sky_excess(const SkyVector& sky) {
    return 0.09 * (double{sky[3]} - 0.5 * double{sky[0]});
}

/// How a sky's scattered sunlight is spread, as shares of that on the horizontal: what comes from
/// round the sun, what a wall receives more of a sky brighter towards the horizon (less: negative),
/// and coefficients of sky functions beyond an even sky.
struct DiffuseSplit {
    double circumsolar = 0.0;  // 0 to 1, on the horizontal
    double horizon = 0.0;
    SkyVector uneven{};   // Σ uneven_k T_k is 0 on open level ground
    bool by_air = false;  // of a scene's air (sky_spread.hpp), else by perez_split()
};
/// By Perez and others (1990, Solar Energy 44, 271), in the continuous form of Driesse and others
/// (2024, Solar Energy 267). None where the sun is down.
///
/// - direct_normal, diffuse: [W m⁻²]
/// - top: sunlight above the air, facing the sun [W m⁻²]
DiffuseSplit perez_split(double direct_normal, double diffuse, double zenith_deg, double top);

/// What a facet sees of the horizon's brightness, per that of a wall. The model takes it for a
/// line: sin(slope) of an open plane. Here it lies within 15° of the horizon, so that what stands
/// there hides it: 0 on level ground, 1 on a wall, within 0.02 of that sine between.
double horizon_view(const SkyVector& sky);

}  // namespace diurna
