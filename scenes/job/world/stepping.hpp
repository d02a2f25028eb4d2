#pragma once

#include <vector>

#include "scenes/job/input/scene.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// Steps and stored instants of a scene's heat balance. Temperatures are stored at every
/// picture and, for spans up to two days, at least each half hour, for daily curves and
/// crossovers; for pictures of moving observers at the steps before and after each, so that
/// many pictures within a minute need only two instants, and a single one gives the same result
/// as in a series.
SpanOptions scene_span(const Scene& scene);

/// The instants between the steps of a scene's span, its ends included.
std::vector<Instant> scene_steps(const Scene& scene);

}  // namespace diurna
