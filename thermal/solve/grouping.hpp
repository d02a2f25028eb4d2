#pragma once

#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// A material, and whether it exchanges longwave only with itself: a facet that sees only its own
/// kind has no net exchange at any temperature.
struct KindOf {
    MaterialId material;
    bool closed;
};

/// Divides the facets into blocks of one kind, and by height and by the sky above if that matters.
/// Returns the kinds in the order of Block::material.
std::vector<KindOf> group_by_material(SolveState& solve);

}  // namespace diurna
