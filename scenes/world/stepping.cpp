#include "scenes/world/stepping.hpp"

#include <cmath>

namespace diurna {

namespace {

/// The longest whole number of steps that meets every frame and every half hour [s].
double kept_every(const TimeInput& time) {
    const auto steps = static_cast<int>(std::lround(time.frame_every / time.step));
    int kept = steps;
    while (kept > 1 && (steps % kept != 0 || kept * time.step > 1800.0)) --kept;
    return kept * time.step;
}

}  // namespace

SolveOptions scene_solve_options(const Scene& scene) {
    SolveOptions options;
    options.start = scene.time.start;
    options.duration = scene.time.duration;
    options.step = scene.time.step;
    options.keep_every = kept_every(scene.time);
    options.periodic = scene.time.duration == 86400.0;
    return options;
}

std::vector<Instant> frame_instants(const TimeInput& time) {
    std::vector<Instant> frames;
    const auto count = std::lround(time.duration / time.frame_every);
    for (long i = 0; i < count; ++i) {
        frames.push_back(later(time.start, static_cast<double>(i) * time.frame_every));
    }
    return frames;
}

}  // namespace diurna
