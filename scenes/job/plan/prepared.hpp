#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "render/rays/plume.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/plan.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// A radiometer at its place: east, north, up [m].
struct PlacedRadiometer {
    RadiometerInput input;
    Eigen::Vector3d place;
};

/// What is known of a scene wherever its moving objects are.
struct SceneParts {
    Scene scene;
    Weather weather;
    std::vector<Sequence> sequences;  // of the observers, in the order of the scene
    Plan plan;
    std::vector<Plume> plumes;  // placed in the same way
    std::vector<PlacedRadiometer> radiometers;
    std::vector<std::string> notes;              // notes on elevation and weather data
    Movement movement;                           // of moving objects
    std::vector<Mistake> warnings;               // implausible values in the files read
    std::shared_ptr<const InstantLights> light;  // for that weather, as in the heat balance
};

/// Its triangles with the moving objects at certain places.
struct ScenePlace {
    World world;
    RayScene rays;
};

/// Everything known after a scene is built: place, triangles, weather, tasks. It does not change
/// afterwards: copies share what they refer to.
struct Prepared {
    std::shared_ptr<const SceneParts> parts;
    std::shared_ptr<const ScenePlace> place;

    const Scene& scene = parts->scene;
    const World& world = place->world;
    const RayScene& rays = place->rays;
    const Weather& weather = parts->weather;
    const std::vector<Sequence>& sequences = parts->sequences;
    const Plan& plan = parts->plan;
    const std::vector<Plume>& plumes = parts->plumes;
    const std::vector<PlacedRadiometer>& radiometers = parts->radiometers;
    const std::vector<std::string>& notes = parts->notes;
    const Movement& movement = parts->movement;
    const std::vector<Mistake>& warnings = parts->warnings;
    const std::shared_ptr<const InstantLights>& light = parts->light;

    Prepared(std::shared_ptr<const SceneParts> of_scene, std::shared_ptr<const ScenePlace> there)
        : parts(std::move(of_scene)), place(std::move(there)) {}
};

/// The light at an instant: that of the heat balance, by wavelength and direction.
LightOfInstant light_at(const Prepared& prepared, Instant instant);

/// The same with the moving objects at other places.
Prepared moved(const Prepared& prepared, const MoverPoses& poses);
/// The same during motion: at ray times 0 and 1 the objects are at their positions `reach` before
/// and after [s].
Prepared moving(const Prepared& prepared, const MoverPoses& poses,
                const std::vector<Motion>& motions, double reach);

/// The same with fewer pictures: the observers and sequences of some of them, in the scene's order.
Prepared with_pictures(const Prepared& prepared, std::vector<ObserverInput> observers,
                       std::vector<Sequence> sequences);

/// Builds the world and makes all checks that are possible before anything is computed or written.
Prepared prepare(Scene scene);

}  // namespace diurna
