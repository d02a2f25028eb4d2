#include "scenes/job/world/light_source.hpp"

#include <algorithm>

#include "terrain/place/moon.hpp"

namespace diurna {

LightSource light_source(const SunPosition& sun, const Site& site, Instant instant,
                         std::span<const Band> bands) {
    const bool moonlight_shows = std::any_of(bands.begin(), bands.end(), [](const Band& band) {
        return band.from_um() < moonlight_ends_um;
    });
    if (sun.elevation_deg > 0.0 || !moonlight_shows) return {sun, {}};
    const MoonPosition moon = moon_position(site, instant);
    if (!(moon.elevation_deg > 0.0)) return {sun, {}};
    return {{moon.azimuth_deg, moon.elevation_deg, 1.0}, moon.light};
}

}  // namespace diurna
