#pragma once

#include <string>
#include <vector>

#include "render/instrument/blur.hpp"
#include "scenes/job/input/scene.hpp"

namespace diurna {

/// The observer of an instrument; its band by its name in the scene.
const ObserverInput& observer_of(const Scene& scene, const InstrumentInput& input);

/// Sampling of an instrument's picture, and its cost.
struct InstrumentCost {
    std::string name;
    Oversampling oversampling;
    int samples = 1;           // rays of each sample of radiance
    double seen_pixels = 0.0;  // samples of radiance per picture, without margins
    std::vector<std::string> left_out;
};
/// Throws InputError, with its place in the scene file, for settings that contradict each other
/// (check_camera()).
InstrumentCost instrument_cost(const Scene& scene, const InstrumentInput& input);

/// Rays per sample of radiance, with `times` samples per pixel in each direction, so that a pixel
/// has at least its observer's number.
int samples_of(const ObserverInput& observer, int times);

}  // namespace diurna
