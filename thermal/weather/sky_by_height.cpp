#include "thermal/weather/sky_by_height.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/weather/light_by_height.hpp"

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
    const LongwaveFormula formula = formula_of_measured(clear);
    const double clear_here = clear_longwave(from, formula);
    const double clear_there = clear_longwave(to, formula);
    if (!(clear_here > 0.0)) return here;
    if (here <= clear_here) return here * clear_there / clear_here;
    const auto black = [](const AirState& air) {
        return stefan_boltzmann * power4(air.temperature);
    };
    if (!(black(from) > clear_here)) return here * clear_there / clear_here;
    const double cover = (here - clear_here) / (black(from) - clear_here);
    return clear_there + cover * (black(to) - clear_there);
}

/// Clear sunlight over a station and over a height, by formula.
struct FormulaSun {
    Sunlight low, high;
};
FormulaSun formula_sun(const SkyState& sky, const Forcing& now, const AirState& there,
                       const AirByHeight& rule, double height, const ClearSky& clear) {
    // Water above a place goes with the vapour near its ground.
    ClearSky above = clear;
    above.precipitable_water_cm *= precipitable_water_cm(there) / precipitable_water_cm(now.air);
    return {clear_sunlight(sky.sun, now.air, rule.station, clear),
            clear_sunlight(sky.sun, there, height, above)};
}

/// Light of the scene's air at a height, moved by as much as the station's is off its air there:
/// the less, the more light the height has than the station (a beam above fog).
double moved_with_station(double station, double air_at_station, double air_there) {
    if (!(air_at_station > least_light) || !(air_there > least_light)) return air_there;
    const double off = std::clamp(station / air_at_station, 0.0, 50.0);
    return air_there * std::pow(off, std::min(1.0, air_at_station / air_there));
}

/// Sunlight by the scene's own air in place of formulas.
void take_air_sunlight(const LightByHeight& air, const FormulaSun& sun, double station,
                       double height, SkyState& sky) {
    const LightRatio there = air.at(sky.when, height);
    const double direct = there.direct * sun.high.direct_normal;
    const double diffuse = there.diffuse * sun.high.diffuse_horizontal;
    const bool over_cloud = height >= air.cloud_top;  // the station's light does not matter there
    if (over_cloud) {
        sky.direct_normal = direct;
        sky.diffuse_horizontal = diffuse;
    } else {
        const LightRatio here = air.at(sky.when, station);
        sky.direct_normal =
            moved_with_station(sky.direct_normal, here.direct * sun.low.direct_normal, direct);
        sky.diffuse_horizontal = moved_with_station(
            sky.diffuse_horizontal, here.diffuse * sun.low.diffuse_horizontal, diffuse);
    }
    if (sky.split.by_air && !over_cloud) return;
    sky.split = perez_split(sky.direct_normal, sky.diffuse_horizontal, 90.0 - sky.sun.elevation_deg,
                            solar_constant / (sky.sun.distance_au * sky.sun.distance_au));
}

/// Longwave by the scene's own air, which under a clear sky is brighter towards the horizon.
void take_air_longwave(const LightByHeight& air, const AirState& there, double height,
                       const ClearSky& clear, SkyState& sky) {
    const double cloudless = clear_longwave(there, clear.longwave);
    const double black = stefan_boltzmann * power4(there.temperature);
    sky.longwave_down = air.at(sky.when, height).longwave * cloudless;
    if (!clear.longwave_by_direction || !(black > cloudless)) return;
    const double open = (black - sky.longwave_down) / (black - cloudless);
    sky.tilted_longwave = std::clamp(open, 0.0, 1.0) * black;
}

void thin_out(const Forcing& now, const AirState& there, const AirByHeight& rule, double height,
              const ClearSky& clear, SkyState& sky) {
    if (sky.by_height && sky.by_height->has_sunlight(height)) {
        take_air_sunlight(*sky.by_height,
                          formula_sun(sky, now, there, rule, height, reference_sky(clear)),
                          rule.station, height, sky);
        return;
    }
    const auto [low, high] = formula_sun(sky, now, there, rule, height, clear);
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
    const LightByHeight* const air = sky.by_height;
    if (air && air->has_longwave(height)) {
        take_air_longwave(*air, there, height, clear, sky);
    } else {
        sky.longwave_down = carried_longwave(sky.longwave_down, now.air, there, clear);
        sky.tilted_longwave *= power4(there.temperature / now.air.temperature);
    }
    if (sky.to_sun.z() > 0.0 && sky.global_horizontal() > 0.0) {
        thin_out(now, there, rule, height, clear, sky);
    }
    return sky;
}

}  // namespace diurna
