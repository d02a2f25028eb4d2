#pragma once

#include <functional>
#include <span>

#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Fills `fraction` (facet) with the share in the sun at an instant for the chosen facets, and
/// leaves the others as they are: `sun_fraction` of terrain/visibility/view_factors.hpp, or what
/// stands for it.
using SunFractionAt =
    std::function<void(Instant, std::span<const std::uint32_t> chosen, std::span<float> fraction)>;

struct EdgeSearch {
    float least_change = 0.4f;  // of the share between two instants that counts as an edge
    double tolerance = 5.0;     // [s]: 5 s late are 0.1 K and less a minute after the edge
};

/// Edges of a day before and of one after, at the same hours: where a facet has one within a step
/// on both, that of the day in between is looked for on the line between them first. They ascend by
/// step and facet, as find_edges leaves them.
struct EdgesAround {
    std::span<const ShadowEdge> before{}, after{};
    double share = 0.0;     // of the way from the day before to that after
    float furthest = 0.5f;  // of a step between the two, for that to be tried
};

/// Fills sun.edge: when, within each step, a facet's share in the sun passes the middle of what it
/// was and what it will be, by halving the step. Facets whose shares agree at both ends are not
/// asked: a shadow that comes and goes within one step stays unseen.
void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search = {},
                const EdgesAround& around = {});

}  // namespace diurna
