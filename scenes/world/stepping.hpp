#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// How the heat balance of a scene goes through its span. Temperatures are kept at every picture
/// and, of spans up to two days, at least each half hour, for the curves of a day and where they
/// cross; for pictures of observers that go at the steps on either side of each, so that many
/// pictures of a minute need no more than two instants, and one alone finds what it finds among
/// others.
SpanOptions scene_span(const Scene& scene);

/// The instants between the steps of a scene's span, its ends included.
std::vector<Instant> scene_steps(const Scene& scene);

}  // namespace diurna
