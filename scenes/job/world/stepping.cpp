#include "scenes/job/world/stepping.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace diurna {

namespace {

/// The step at an instant, or the two on either side of it.
void add_steps_around(Instant when, const std::vector<Instant>& steps, std::vector<Instant>& to) {
    const auto after = std::lower_bound(steps.begin(), steps.end(), when);
    if (after != steps.end()) to.push_back(*after);
    if (after != steps.begin() && (after == steps.end() || *after != when)) {
        to.push_back(*std::prev(after));
    }
}

}  // namespace

SpanOptions scene_span(const Scene& scene) {
    constexpr double curve_every = 1800.0, longest_curve = 2.0 * 86400.0;  // [s]
    const TimeInput& time = scene.time;
    SolveOptions day{.step = time.step};
    if (scene.exact) day.least_dew = 0.0;
    SpanOptions span{.day = day,
                     .start = time.start,
                     .end = time.end(),
                     .begin = time.spin_up,
                     .days_before = time.days_before,
                     .wanted = time.frames,
                     .heat = scene.output.fluxes || !scene.radiometers.empty(),
                     .goes_on = scene.output.state};
    if (time.duration <= longest_curve) {
        const auto count = std::lround(std::ceil(time.duration / curve_every));
        for (long i = 0; i <= count; ++i) {
            const double at = std::min(time.duration, double(i) * curve_every);
            span.wanted.push_back(later(time.start, at));
        }
    }
    std::vector<Instant> steps;
    if (time.every_step || !scene.radiometers.empty()) {
        steps = scene_steps(scene);
        span.wanted.insert(span.wanted.end(), steps.begin(), steps.end());
    }
    for (const ObserverInput& observer : scene.observers) {
        if (!observer.goes()) {
            span.wanted.insert(span.wanted.end(), observer.frames.begin(), observer.frames.end());
            continue;
        }
        if (steps.empty()) steps = scene_steps(scene);
        for (const Instant when : observer.frames) add_steps_around(when, steps, span.wanted);
    }
    std::sort(span.wanted.begin(), span.wanted.end());
    span.wanted.erase(std::unique(span.wanted.begin(), span.wanted.end()), span.wanted.end());
    return span;
}

std::vector<Instant> scene_steps(const Scene& scene) {
    return step_instants(
        {.start = scene.time.start, .duration = scene.time.duration, .step = scene.time.step});
}

}  // namespace diurna
