#pragma once

#include <functional>
#include <span>

#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Computes `fraction` (facet), the share in the sun at an instant, for the chosen facets; the
/// others are unchanged: `sun_fraction` of terrain/visibility/view_factors.hpp, or a
/// replacement.
using SunFractionAt =
    std::function<void(Instant, std::span<const std::uint32_t> chosen, std::span<float> fraction)>;

struct EdgeSearch {
    float least_change = 0.4f;  // of the share between two instants, for an edge
    double tolerance = 5.0;     // [s]: 5 s cause 0.1 K and less a minute after the edge
};

/// Edges of an earlier and of a later day, at the same hours: if a facet has one within a step on
/// both, the edge of the day in between is first searched at the interpolated time. In ascending
/// order of step and facet, as from find_edges.
struct EdgesAround {
    std::span<const ShadowEdge> before{}, after{};
    double share = 0.0;     // fraction of the way from the earlier day to the later
    float furthest = 0.5f;  // of a step between the two, for this to be tried
};

/// Computes sun.edge: when, within each step, a facet's share in the sun passes the mean of its
/// values at both ends, by bisection. Facets with equal shares at both ends are skipped: a shadow
/// that comes and goes within one step is not detected.
void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search = {},
                const EdgesAround& around = {});

}  // namespace diurna
