#pragma once

#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The material to which the reflected light of a weather file applies.
struct MeasuredAlbedo {
    std::vector<double> share{};  // (material) SolveInput::measured_share; empty: none
    std::string note{};           // why it is none, though measured or requested
};

/// The material of `[weather] measured_over`, or the scene's only one. Levels of a texture on it
/// keep their albedo's ratio to its own.
MeasuredAlbedo measured_albedo(const Scene& scene, const World& world, const Weather& weather);

}  // namespace diurna
