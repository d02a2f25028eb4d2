#pragma once

#include <optional>
#include <span>

#include "materials/atmosphere/moonlight.hpp"
#include "materials/radiation/band.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

/// The external light source of a scene. Below the horizon: none.
struct LightSource {
    SunPosition place;              // the moon's with 1 au
    std::optional<MoonLight> moon;  // else the sun
};

/// The sun (apparent_sun of thermal/weather/apparent_sun.hpp) while it is up; then the moon if it
/// is up, for pictures in a band that begins below 3 µm. Not modelled: twilight, the light of a sun
/// below the horizon, which exceeds moonlight until the sun is some 8° below, and the earth's
/// shadow on an eclipsed moon.
LightSource light_source(const SunPosition& sun, const Site& site, Instant instant,
                         std::span<const Band> bands);

}  // namespace diurna
