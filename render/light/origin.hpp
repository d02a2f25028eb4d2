#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace diurna {

/// Origin of light before surfaces reflected it, which determines its absorption so far, and so the
/// absorption by the air in front of the eye (materials/atmosphere/onward_light.hpp).
///
///     surface   emitted by a surface, or by a room behind it: no air so far
///     sunlight  of the sun, direct or scattered by the air
///     sky_heat  emitted by air and clouds
enum class Origin { surface, sunlight, sky_heat };
inline constexpr std::size_t origin_count = 3;
inline constexpr std::array<Origin, origin_count> all_origins = {Origin::surface, Origin::sunlight,
                                                                 Origin::sky_heat};

/// A spectrum by its origins, (origin)(node); empty for absent origins.
using LightByOrigin = std::array<std::vector<double>, origin_count>;

/// Its spectrum from one origin.
inline std::vector<double>& from(LightByOrigin& light, Origin origin) {
    return light[static_cast<std::size_t>(origin)];
}
inline const std::vector<double>& from(const LightByOrigin& light, Origin origin) {
    return light[static_cast<std::size_t>(origin)];
}
inline LightByOrigin from_surface(std::vector<double> spectrum) {
    LightByOrigin light;
    from(light, Origin::surface) = std::move(spectrum);
    return light;
}

}  // namespace diurna
