#pragma once

#include <vector>

#include "render/picture/cube.hpp"
#include "render/picture/frame.hpp"
#include "scenes/job/run/camera_truth.hpp"
#include "scenes/job/run/series.hpp"

namespace diurna {

/// The picture of an observer at an instant.
struct Picture {
    Frame frame;             // of its bands, its notes those of the tables' errors
    std::vector<Cube> cube;  // of its cubes
    Facts facts;             // camera and instant
    CameraTags camera;
    double sample_error = 0.0;  // [K] of its number of samples (sample_error.hpp); 0: not estimated
};

/// - series: cast from the observer's pose
/// - field: temperatures around the instant
/// - blurred: objects move during the exposure
/// Throws std::runtime_error for a radiance that is not finite.
Picture picture_at(const Prepared& prepared, const Series& series, const FacetViews& views,
                   const TemperatureField& field, Instant instant, bool blurred = false);

/// The truth plane "void": 1 at pixels whose ground was filled in at missing elevations
/// (World::filled, which is not empty), 0 elsewhere, −1 for sky.
Plane void_plane(const View& view, const World& world);

}  // namespace diurna
