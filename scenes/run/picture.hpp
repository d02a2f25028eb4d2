#pragma once

#include <vector>

#include "render/picture/cube.hpp"
#include "render/picture/frame.hpp"
#include "scenes/run/camera_truth.hpp"
#include "scenes/run/series.hpp"

namespace diurna {

/// What an observer sees at an instant.
struct Picture {
    Frame frame;             // of its bands, its notes those of the tables' errors
    std::vector<Cube> cube;  // of its cubes
    Facts facts;             // camera and instant
    CameraTags camera;
};

/// - series: cast from where the observer is
/// - field: temperatures about the instant
/// - blurred: objects go on while the picture is taken
/// Throws std::runtime_error for a radiance that is not finite.
Picture picture_at(const Prepared& prepared, const Series& series, const FacetViews& views,
                   const TemperatureField& field, Instant instant, bool blurred = false);

/// The truth plane "void": 1 at pixels whose ground was filled in for want of elevation
/// (World::filled, which is not empty), 0 elsewhere, −1 where it is sky.
Plane void_plane(const View& view, const World& world);

}  // namespace diurna
