#pragma once

#include <memory>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "render/rays/plume.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/plan/plan.hpp"
#include "scenes/plan/sequence.hpp"
#include "scenes/world/instant_lights.hpp"
#include "scenes/world/movers.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// A radiometer where it stands: east, north, up [m].
struct PlacedRadiometer {
    RadiometerInput input;
    Eigen::Vector3d place;
};

/// Everything a job knows once the scene stands: place, triangles, weather, what is to be done.
struct Prepared {
    Scene scene;
    World world;
    RayScene rays;
    Weather weather;
    std::vector<Sequence> sequences;  // of the observers, in the order of the scene
    Plan plan;
    std::vector<Plume> plumes;  // placed likewise
    std::vector<PlacedRadiometer> radiometers;
    std::vector<std::string> notes;  // what a reader should know of elevation and weather data
    Movement movement;               // of objects that go
    std::vector<Mistake> warnings;   // of the files read: what is implausible in them
    std::shared_ptr<const InstantLights> light;  // of that weather, as the heat balance has it
};

/// The light of an instant: what the heat balance receives, by wavelength and direction.
LightOfInstant light_at(const Prepared& prepared, Instant instant);

/// The same with the objects that go in other places.
Prepared moved(const Prepared& prepared, const MoverPoses& poses);
/// The same while they go on: at the times 0 and 1 of rays they are where they are `reach` before
/// and after [s].
Prepared moving(const Prepared& prepared, const MoverPoses& poses,
                const std::vector<Motion>& motions, double reach);

/// Builds the world and checks what can be checked before anything is computed or written.
Prepared prepare(Scene scene);

}  // namespace diurna
