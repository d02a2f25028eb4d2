#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/radiation/spectrum.hpp"
#include "scenes/job/input/scene_places.hpp"

namespace diurna {

/// Smoke or gas of a scene, [[plume]]: a leaning column, a frustum of 24 sides.
struct PlumeInput {
    std::string name;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its base; east, north [m]
    HeightInput stands;                               // its base
    double height = 10.0;                             // [m]
    double radius = 1.0, top_radius = 1.0;            // [m]
    Eigen::Vector2d lean = Eigen::Vector2d::Zero();   // offset of its top; east, north [m]
    double temperature = 300.0;                       // [K]
    Spectrum absorption;                              // [m⁻¹]
    std::filesystem::path file;                       // of the absorption; empty: one number
};

/// Reads every table of [[plume]]; mistakes are noted.
std::vector<PlumeInput> read_plumes(const Section& root, const ScenePlaces& places);

}  // namespace diurna
