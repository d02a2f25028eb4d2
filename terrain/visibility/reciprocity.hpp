#pragma once

#include <cstddef>
#include <span>

#include "materials/matter/passed_light.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

struct ReciprocityOptions {
    /// Pairs with both view factors below this are skipped at random, the others raised to it, so
    /// that the mean is preserved for near and far pairs (adding the skipped part to a row's larger
    /// entries made the foot of a wall 3H deep 15 % too bright).
    double cut_off = 2e-3;
    double closure = 1e-5;  // tolerance of rows' sums, 1 − sky − below
    int passes = 30;
    std::span<const PassedLight> passed{};  // (material) as in RayScene; empty: all opaque
    bool sunlight = false;                  // as in FacetViewOptions
};

struct ReciprocityReport {
    std::size_t pairs = 0, left_out = 0;
    double worst_closure = 0.0;  // before the rest was added to `below`
    int passes = 0;
};

/// Makes sampled view factors (view_factor_sampling.hpp) reciprocal, A_i F_ij = A_j F_ji to float
/// rounding, and preserves each row's sum: sky + below + Σ row = 1.
///
/// If h of n_i rays of one facet and n_j of the other meet, the most likely exchange area is h /
/// (λ_i/A_i + λ_j/A_j), with λ = n for unconstrained rows. Here λ is such that the rows close
/// (Lagrange multipliers of the maximum likelihood under that constraint, by fixed-point iteration,
/// within a factor of 8 of n). So a large facet met by few rays does not distort the rows of the
/// small ones that see it well. A row that cannot be filled (its few partners are used by others)
/// adds the rest to `below`, ground like its own; one that its partners overfill gives up to 0.02
/// of its sky. At most twice as many entries as were sampled: memory is linear in the facets, rays
/// per facet × share of ground seen × 16 bytes.
///
/// Views of copies (FacetViews::copied) keep their share of the hemisphere and are added to the
/// rows last: this exchange is one-way.
///
/// Ground under a building would see the walls' backs, which do not see it: it would lose most of
/// its view to `below`. Scenes have no ground there (scenes/job/world/world).
ReciprocityReport make_reciprocal(const FacetSet& facets, FacetViews& views,
                                  const ReciprocityOptions& options = {});

}  // namespace diurna
