#include "thermal/weather/sky_by_height.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

// A sun on the horizon divides next to nothing by next to nothing.
constexpr double least_ratio = 0.5, most_ratio = 2.0, least_light = 0.1;  // [], [], [W m⁻²]

double ratio(double there, double here) {
    return here > least_light ? std::clamp(there / here, least_ratio, most_ratio) : 1.0;
}

/// Longwave over other air: between that of its clear sky and its black body where it was here, so
/// that an overcast stays one; of a sky darker than the clear one here, by the clear skies' ratio.
double carried_longwave(double here, const AirState& from, const AirState& to,
                        const ClearSky& clear) {
    const double clear_here = clear_longwave(from, clear.longwave);
    const double clear_there = clear_longwave(to, clear.longwave);
    if (!(clear_here > 0.0)) return here;
    if (here <= clear_here) return here * clear_there / clear_here;
    const auto black = [](const AirState& air) {
        return stefan_boltzmann * power4(air.temperature);
    };
    if (!(black(from) > clear_here)) return here * clear_there / clear_here;
    const double cover = (here - clear_here) / (black(from) - clear_here);
    return clear_there + cover * (black(to) - clear_there);
}

void thin_out(const Forcing& now, const AirState& there, const AirByHeight& rule, double height,
              const ClearSky& clear, SkyState& sky) {
    // Water above a place goes with the vapour near its ground.
    ClearSky above = clear;
    above.precipitable_water_cm *= precipitable_water_cm(there) / precipitable_water_cm(now.air);
    const Sunlight low = clear_sunlight(sky.sun, now.air, rule.station, clear);
    const Sunlight high = clear_sunlight(sky.sun, there, height, above);
    const double sine = sky.to_sun.z();
    const double global = ratio(high.direct_normal * sine + high.diffuse_horizontal,
                                low.direct_normal * sine + low.diffuse_horizontal);
    const double clearness = low.direct_normal > least_light
                                 ? std::min(1.0, sky.direct_normal / low.direct_normal)
                                 : 0.0;
    sky.direct_normal *= ratio(high.direct_normal, low.direct_normal);
    sky.diffuse_horizontal *=
        std::lerp(global, ratio(high.diffuse_horizontal, low.diffuse_horizontal), clearness);
    if (sky.split.by_air) return;
    sky.split = perez_split(sky.direct_normal, sky.diffuse_horizontal, 90.0 - sky.sun.elevation_deg,
                            solar_constant / (sky.sun.distance_au * sky.sun.distance_au));
}

}  // namespace

SkyState sky_at_height(const SkyState& station, const Forcing& now, const AirState& there,
                       const AirByHeight& rule, double height, const ClearSky& clear) {
    SkyState sky = station;
    sky.longwave_down = carried_longwave(sky.longwave_down, now.air, there, clear);
    sky.tilted_longwave *= power4(there.temperature / now.air.temperature);
    if (sky.to_sun.z() > 0.0 && sky.global_horizontal() > 0.0) {
        thin_out(now, there, rule, height, clear, sky);
    }
    return sky;
}

}  // namespace diurna
