#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/input/read_height.hpp"
#include "scenes/input/read_time.hpp"
#include "scenes/input/scene_places.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

/// One table [[trajectory]]: a way that observers and objects go.
struct TrajectoryInput {
    std::string name;
    /// Seconds from `start`; east, north of the site [m], or, as `geodetic`, longitude and latitude
    /// [deg]; height [m] over what `heights` says.
    Trajectory way;
    bool geodetic = false;
    HeightOver heights = HeightOver::ground;
    Instant start;
    std::filesystem::path file;  // "": the scene's own
    std::string where;           // in the scene file
    bool sound = true;           // else another way stands for one that has a mistake

    Instant begin() const { return later(start, way.begin()); }
    Instant end() const { return later(start, way.end()); }
    /// [m] of a unit of its places' first two parts, about.
    double metres() const { return geodetic ? 111e3 : 1.0; }
};

/// The tables [[trajectory]]; by default a way starts as the scene's span does.
std::vector<TrajectoryInput> read_trajectories(const Section& root, const TimeInput& time,
                                               const ScenePlaces& places);

/// That of a name; null where there is none.
const TrajectoryInput* find_trajectory(const std::vector<TrajectoryInput>& ways,
                                       const std::string& name);

}  // namespace diurna
