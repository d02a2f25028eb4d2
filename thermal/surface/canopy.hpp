#pragma once

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// Leaves that hide the ground, joined to it by a skin's conductance: the balance is the skin's,
/// and the ground gets what the skin conducts.
SurfaceTerms big_leaf_terms(const SurfaceConditions& conditions, const BigLeaf& leaf,
                            double ground_temperature);

/// Leaves above, ground between, each with a balance of its own (after Norman, Kustas & Humes
/// 1995): both open to the sky by their share of the view from above, and facing one another over
/// the leaves' share.
SurfaceTerms two_source_terms(const SurfaceConditions& conditions, const TwoSource& canopy,
                              double ground_temperature);

}  // namespace diurna
