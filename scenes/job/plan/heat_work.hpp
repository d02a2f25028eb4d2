#pragma once

#include <span>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/plan/solved_days.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Facets that need more than their blocks give them.
struct PointWork {
    double seconds = 0.0;   // of the processor
    double wet = 0.0;       // facets that hold water, and
    double freezing = 0.0;  // those whose water freezes
};
/// Most of their time is where dew, rain and frost come and go, however long the steps are; the
/// first day repeats.
PointWork point_work(const Scene& scene, const World& world, const Weather& weather,
                     const SolvedDays& days);

/// Facets that are solved, as far as is known before views are cast: objects, what pictures show,
/// ground that exchanges heat with it, and representatives.
///
/// - every: HeatDecision::every_facet is not empty
/// - close_ground: SkyWork::close_ground
double solved_facets(const World& world, std::span<const Sequence> sequences, bool every,
                     double close_ground);

/// Processor time of targets' networks [s]: their first day repeats, those after it are gone
/// through.
///
/// - facets: of all targets
double network_seconds(const Scene& scene, double facets, const SolvedDays& days);

}  // namespace diurna
