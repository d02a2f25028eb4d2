#pragma once

#include <string>

#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/solve_report.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// "facet 81 of semi_desert"
std::string facet_name(const SolveState& solve, std::size_t facet);
/// The facets with the largest residual of the periodic day; "" if there are none.
std::string furthest_facets(const SolveState& solve, const PointFacets& points,
                            const NetworkFacets& targets);

/// One line of progress: number of the pass, residual against
/// its limit, and the facet and material with the largest
/// one.
///
/// - report: after the pass and the exchange that followed it
std::string what_is_left(const SolveState& solve, const PointFacets& points,
                         const NetworkFacets& targets, const SolveReport& report);

}  // namespace diurna
