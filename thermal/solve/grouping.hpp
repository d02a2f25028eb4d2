#pragma once

#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// A material, and whether all its longwave stays with it: what sees nothing but its own like
/// neither loses any nor takes any in, however warm it is.
struct KindOf {
    MaterialId material;
    bool closed;
};

/// Cuts the facets into blocks of one kind, and by height and by what is above them where that
/// makes a difference. Returns the kinds in the order of Block::material.
std::vector<KindOf> group_by_material(SolveState& solve);

}  // namespace diurna
