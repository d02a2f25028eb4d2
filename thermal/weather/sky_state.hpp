#pragma once

#include <Eigen/Core>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/clear_sky.hpp"
#include "thermal/weather/sky_shape.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The sky over the whole scene at one instant.
struct SkyState {
    SunPosition sun;
    Eigen::Vector3d to_sun;                // unit, east-north-up
    double direct_normal = 0.0;            // beam on a plane facing the sun [W m⁻²]
    double diffuse_horizontal = 0;         // [W m⁻²]
    DiffuseSplit split{};                  // of the diffuse light
    double longwave_down = 0.0;            // on the horizontal [W m⁻²]
    double tilted_longwave = 0.0;          // factor of tilted_sky_excess [W m⁻²]
    double albedo = not_measured;          // measured up over down, replaces the material's
    double plane_of_array = not_measured;  // measured on the facet, replaces the transposition
    /// Of the series it comes from, which outlives it; null: formulas carry it to other heights.
    const LightByHeight* by_height = nullptr;
    Instant when{};  // for that

    double global_horizontal() const;
};

/// The sky at one instant: measured values where available, else the clear-sky model with its
/// cloud; for series see SkySeries. Global sun alone is split by its clearness index (Erbs);
/// global, direct and diffuse together are made consistent with the global. Cloud without measured
/// sun reduces global and direct by Kasten & Czeplak's factors
/// (materials/atmosphere/cloud_modification.hpp).
SkyState sky_state(const Site& site, double elevation, Instant instant, const Forcing& forcing,
                   const ClearSky& clear = {});
/// The same for a given position of the sun, without refraction.
SkyState sky_state(const SunPosition& geometric, double elevation, const Forcing& forcing,
                   const ClearSky& clear = {});

/// A facet's view of the sky: its view factor, 0 to 1, its view of the horizon (sky_shape.hpp); its
/// shares T_k of sky functions, used if the sky has coefficients of them.
struct OpenSky {
    double view = 1.0, horizon = 0.0;
    SkyVector shares{};
};
OpenSky open_sky(const SkyVector& shares);

/// Sunlight of the sky by DiffuseSplit [W m⁻²]: the part from the direction of the sun, on a plane
/// facing it, the uniform part, the excess on a wall due to a brighter horizon, and coefficients of
/// sky functions.
struct SkyLight {
    double beam = 0.0, even = 0.0, horizon = 0.0;
    SkyVector uneven{};
};
SkyLight sky_light(const SkyState& sky);

/// Sunlight on a facet [W m⁻²] without reflections by other facets: the beam and the circumsolar
/// part of the diffuse light come from the sun's direction and share its shadow, one part comes
/// from the horizon, the rest uniformly from the visible sky.
///
/// - seen: normal · to_sun, not below 0, times the share of facet and disc not in shadow
double facet_sunlight(const SkyLight& light, double seen, const OpenSky& open);
/// The same for a sky.
///
/// - sun_cosine: normal · to_sun
/// - sun_fraction: share of facet and disc not in shadow, 0 to 1
double facet_sunlight(const SkyState& sky, double sun_cosine, double sun_fraction,
                      const OpenSky& open);

}  // namespace diurna
