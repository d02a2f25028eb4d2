#pragma once

#include <array>
#include <map>
#include <mutex>
#include <optional>

#include "materials/atmosphere/light_of_instant.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

/// The light of an instant for pictures and studies: the scene's air, scaled so that level ground
/// at the scene's origin receives the same as in the heat balance, beam, diffuse and longwave.
///
/// - sky: of the weather of the heat balance (Prepared::weather)
///
/// A table of paths and a vacuum cannot be scaled: their sums are the heat balance's. Those of a
/// vacuum agree where nothing was measured (thermal/weather/clear_sky.hpp), except for the sun's
/// light outside 0.3 to 5 µm (1.7 %).
LightOfInstant scene_light(const Scene& scene, const World& world, const SkySeries& sky,
                           Instant instant);

/// The sky of a scene's weather, and the light of the instants that were requested: each is
/// computed once. Safe to share between threads.
class InstantLights {
 public:
    InstantLights(const Scene& scene, const World& world, const Weather& weather);

    const SkySeries& sky() const { return sky_; }
    /// - world: its objects may have moved
    LightOfInstant at(const Scene& scene, const World& world, Instant instant) const;

 private:
    using Key = std::array<double, 3>;  // [s], lowest and highest surface [m]
    SkySeries sky_;
    std::optional<HeightSpan> ground_;  // which does not move; nothing: a scene without ground
    mutable std::mutex mutex_;
    mutable std::map<Key, LightOfInstant> found_;
};

}  // namespace diurna
