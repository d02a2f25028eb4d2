#pragma once

#include <string>
#include <vector>

#include "render/instrument/blur.hpp"
#include "scenes/input/scene.hpp"

namespace diurna {

/// The observer of an instrument; its band as the scene names it.
const ObserverInput& observer_of(const Scene& scene, const InstrumentInput& input);

/// How an instrument's picture is sampled, and what that costs.
struct InstrumentCost {
    std::string name;
    Oversampling oversampling;
    int samples = 1;           // rays of each sample of radiance
    double seen_pixels = 0.0;  // samples of radiance a picture; margins beyond its edges skipped
    std::vector<std::string> left_out;
};
/// Throws InputError, with its place in the scene file, for settings that contradict each other
/// (check_camera()).
InstrumentCost instrument_cost(const Scene& scene, const InstrumentInput& input);

/// Rays of a sample of radiance, `times` a pixel each way, so that a pixel has no fewer than its
/// observer says.
int samples_of(const ObserverInput& observer, int times);

}  // namespace diurna
