#pragma once

#include <functional>
#include <span>

#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Fills `fraction` (facet) with the share in the sun at an instant for the chosen facets (1), and
/// leaves the others as they are: `sun_fraction` of terrain/visibility/view_factors.hpp, or what
/// stands for it.
using SunFractionAt =
    std::function<void(Instant, std::span<const std::uint8_t> chosen, std::span<float> fraction)>;

struct EdgeSearch {
    float least_change = 0.4f;  // of the share between two instants that counts as an edge
    double tolerance = 5.0;     // [s]: 5 s late are 0.1 K and less a minute after the edge
};

/// Fills sun.edge: when, within each step, a facet's share in the sun passes the middle of what it
/// was and what it will be, by halving the step. Facets whose shares agree at both ends are not
/// asked: a shadow that comes and goes within one step stays unseen.
void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search = {});

}  // namespace diurna
