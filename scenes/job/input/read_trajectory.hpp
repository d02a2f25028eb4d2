#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/input/read_height.hpp"
#include "scenes/job/input/read_time.hpp"
#include "scenes/job/input/scene_places.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

/// One table [[trajectory]]: a trajectory of observers and objects.
struct TrajectoryInput {
    std::string name;
    /// Seconds from `start`; east, north of the site [m], or, if `geodetic`, longitude and latitude
    /// [deg]; height [m] above the reference `heights`.
    Trajectory way;
    bool geodetic = false;
    HeightOver heights = HeightOver::ground;
    Instant start;
    std::filesystem::path file;  // "": the scene's own
    std::string where;           // in the scene file
    bool sound = true;           // else a placeholder for one with a mistake

    Instant begin() const { return later(start, way.begin()); }
    Instant end() const { return later(start, way.end()); }
    /// Approximate [m] per unit of its places' first two coordinates.
    double metres() const { return geodetic ? 111e3 : 1.0; }
};

/// The tables [[trajectory]]; by default a trajectory starts with the scene's span.
std::vector<TrajectoryInput> read_trajectories(const Section& root, const TimeInput& time,
                                               const ScenePlaces& places);

/// The trajectory with a name; null if there is none.
const TrajectoryInput* find_trajectory(const std::vector<TrajectoryInput>& ways,
                                       const std::string& name);

}  // namespace diurna
