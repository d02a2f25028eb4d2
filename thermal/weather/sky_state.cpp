#include "thermal/weather/sky_state.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/atmosphere/cloud_modification.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

namespace {

// A sun closer than this (5°) to the horizon divides light by almost nothing; what is brighter
// round it counts as even (the bound of Perez et al. 1990).
constexpr double least_sine = 0.087;

}  // namespace

double SkyState::global_horizontal() const {
    return direct_normal * std::max(0.0, to_sun.z()) + diffuse_horizontal;
}

SkyState sky_state(const Site& site, double elevation, Instant instant, const Forcing& forcing,
                   const ClearSky& clear) {
    return sky_state(sun_position(site, instant), elevation, forcing, clear);
}

namespace {

/// Sunlight where global, direct or diffuse was measured.
void take_measured_sun(const Forcing& forcing, double top, SkyState& sky) {
    const bool has_global = !std::isnan(forcing.shortwave_down);
    const bool has_direct = !std::isnan(forcing.direct_normal);
    const bool has_diffuse = !std::isnan(forcing.diffuse);
    const double sine = sky.to_sun.z();
    const bool up = sine > 0.0;
    const double global = std::max(0.0, forcing.shortwave_down);
    if (has_direct && has_diffuse) {
        sky.direct_normal = up ? std::max(0.0, forcing.direct_normal) : 0.0;
        sky.diffuse_horizontal = std::max(0.0, forcing.diffuse);
        const double sum = sky.global_horizontal();
        if (has_global && sum > 0.0) {
            sky.direct_normal *= global / sum;
            sky.diffuse_horizontal *= global / sum;
        } else if (has_global) {
            sky.diffuse_horizontal = global;
        }
        return;
    }
    double diffuse = global;
    if (has_diffuse) {
        diffuse = std::clamp(forcing.diffuse, 0.0, global);
    } else if (has_direct && up) {
        diffuse = std::max(0.0, global - std::max(0.0, forcing.direct_normal) * sine);
    } else if (up) {
        diffuse = global * erbs_diffuse_share(global / (top * std::max(sine, least_sine)));
    }
    if (!up) diffuse = global;
    // The beam is no stronger than above the air; what is left over came from the sky.
    sky.direct_normal = up ? std::min((global - diffuse) / sine, top) : 0.0;
    sky.diffuse_horizontal = global - sky.direct_normal * std::max(0.0, sine);
}

/// Sunlight of a clear sky and what cloud leaves of it, where at most one part was measured.
void model_sun(const Forcing& forcing, double pressure, double elevation, const ClearSky& clear,
               SkyState& sky) {
    const double sine = sky.to_sun.z();
    AirState air = forcing.air;
    air.pressure = pressure;
    const Sunlight sun = clear_sunlight(sky.sun, air, elevation, clear);
    const bool cloudless = std::isnan(forcing.cloud_fraction) || clear.bare_sun;
    const double cloud = cloudless ? 0.0 : forcing.cloud_fraction;
    const double clear_global = sun.direct_normal * sine + sun.diffuse_horizontal;
    // (T26) of docs/theory.md
    const CloudEffect left = kasten_czeplak(cloud);
    const double under_cloud = clear_global * left.global;
    const double beam = sun.direct_normal * left.beam;
    sky.direct_normal =
        std::isnan(forcing.direct_normal) ? beam : std::max(0.0, forcing.direct_normal);
    sky.diffuse_horizontal =
        std::max(0.0, std::isnan(forcing.diffuse) ? under_cloud - beam * sine : forcing.diffuse);
}

/// Longwave on the horizontal, and how much of it is brighter towards the horizon.
void take_longwave(const Forcing& forcing, const ClearSky& clear, SkyState& sky) {
    const AirState& air = forcing.air;
    const bool measured = !std::isnan(forcing.longwave_down);
    if (measured) {
        sky.longwave_down = forcing.longwave_down;
    } else {
        sky.longwave_down = std::isnan(forcing.cloud_fraction)
                                ? clear_longwave(air, clear.longwave)
                                : cloudy_longwave(air, forcing.cloud_fraction, clear.longwave);
    }
    const bool dark = !measured && clear.longwave == LongwaveFormula::none;
    if (!clear.longwave_by_direction || dark) return;
    // Overcast is even. Where only the flux was measured, Crawford and Duchon's cloud follows from
    // it; a sky darker than clear air's is so in all directions.
    const double black = stefan_boltzmann * power4(air.temperature);
    const double cloudless = clear_longwave(air, formula_of_measured(clear));
    double share = 1.0 - forcing.cloud_fraction;
    if (measured) {
        share = sky.longwave_down < cloudless
                    ? std::max(0.0, sky.longwave_down / cloudless)
                    : std::max(0.0, (black - sky.longwave_down) / (black - cloudless));
    }
    if (std::isnan(share)) share = 1.0;
    sky.tilted_longwave = std::clamp(share, 0.0, 1.0) * black;
}

}  // namespace

SkyState sky_state(const SunPosition& geometric, double elevation, const Forcing& forcing,
                   const ClearSky& clear) {
    const AirState& air = forcing.air;
    const double pressure = air.pressure > 0.0 ? air.pressure : standard_pressure(elevation);
    SkyState sky;
    sky.sun = apparent_sun(geometric, air, elevation);
    sky.to_sun = sun_direction(sky.sun);
    const double top = solar_constant / (sky.sun.distance_au * sky.sun.distance_au);

    const bool has_global = !std::isnan(forcing.shortwave_down);
    const bool has_both = !std::isnan(forcing.direct_normal) && !std::isnan(forcing.diffuse);
    if (has_global || has_both) {
        take_measured_sun(forcing, top, sky);
    } else if (sky.to_sun.z() > 0.0) {
        model_sun(forcing, pressure, elevation, clear, sky);
    }
    sky.split =
        perez_split(sky.direct_normal, sky.diffuse_horizontal, 90.0 - sky.sun.elevation_deg, top);
    take_longwave(forcing, clear, sky);

    // Below 5 W/m² two pyranometers' offsets are larger than the albedo they would give.
    const double global = std::max(0.0, forcing.shortwave_down);
    if (has_global && global > 5.0 && !std::isnan(forcing.shortwave_up)) {
        sky.albedo = std::clamp(forcing.shortwave_up / global, 0.0, 1.0);
    }
    if (!std::isnan(forcing.plane_of_array)) {
        sky.plane_of_array = std::max(0.0, forcing.plane_of_array);
    }
    return sky;
}

SkyLight sky_light(const SkyState& sky) {
    const double sine = sky.to_sun.z(), diffuse = sky.diffuse_horizontal;
    const double horizon = diffuse * sky.split.horizon;
    if (!(sine > 0.0)) return {.beam = 0.0, .even = diffuse, .horizon = horizon, .uneven = {}};
    // Circumsolar light is that of a beam; near the horizon its strength is bounded.
    const double circumsolar = diffuse * sky.split.circumsolar * std::min(1.0, sine / least_sine);
    SkyLight light{.beam = sky.direct_normal + circumsolar / sine,
                   .even = diffuse - circumsolar,
                   .horizon = horizon,
                   .uneven = sky.split.uneven};
    for (float& of_function : light.uneven) of_function *= float(diffuse);
    return light;
}

double facet_sunlight(const SkyLight& light, double seen, const OpenSky& open) {
    // (T27) of docs/theory.md
    float uneven = 0.0f;
    for (std::size_t k = 0; k < sky_functions; ++k) uneven += light.uneven[k] * open.shares[k];
    return light.beam * seen +
           std::max(0.0, light.even * open.view + light.horizon * open.horizon + double{uneven});
}

OpenSky open_sky(const SkyVector& shares) {
    return {.view = double{shares[0]}, .horizon = horizon_view(shares), .shares = shares};
}

double facet_sunlight(const SkyState& sky, double sun_cosine, double sun_fraction,
                      const OpenSky& open) {
    return facet_sunlight(sky_light(sky), std::max(0.0, sun_cosine) * sun_fraction, open);
}

}  // namespace diurna
