#pragma once

#include <string>

#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/solve_report.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// "facet 81 of semi_desert"
std::string facet_name(const SolveState& solve, std::size_t facet);
/// The facets whose day is furthest from repeating itself; "" where there are none.
std::string furthest_facets(const SolveState& solve, const PointFacets& points,
                            const NetworkFacets& targets);

/// In a line which pass this was, how far it has left the span from what will do, and which facet,
/// of which material, is the furthest: for who waits for a solve that takes long.
///
/// - report: after the pass and the exchange that followed it
std::string what_is_left(const SolveState& solve, const PointFacets& points,
                         const NetworkFacets& targets, const SolveReport& report);

}  // namespace diurna
