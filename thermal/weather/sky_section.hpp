#pragma once

#include "materials/base/section.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna {

/// The keys of [sky] in scene and column files: models for sunlight and longwave that were not
/// measured.
ClearSky read_sky(const Section& sky);

inline constexpr const char* sky_says = "models for radiation that was not measured";

}  // namespace diurna
