#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/scene_places.hpp"

namespace diurna {

/// [[radiometer]]: simulated readings of pyranometers and pyrgeometers at a place.
struct RadiometerInput {
    std::string name;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // east, north [m]
    HeightInput stands;
    std::optional<Eigen::Vector3d> normal{};  // unit, east, north, up; none: six directions
    std::string where;                        // in the scene file
};

/// Reads every table of [[radiometer]]; mistakes are noted.
std::vector<RadiometerInput> read_radiometers(const Section& root, const ScenePlaces& places);

}  // namespace diurna
