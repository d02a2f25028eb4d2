#pragma once

#include <cstddef>
#include <span>

#include "materials/matter/passed_light.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

struct ReciprocityOptions {
    /// Of pairs where neither sees more of the other than this, so many are skipped at random that
    /// the others, raised to it, stand for all: near and far partners keep what is theirs in the
    /// mean (to give it to a row's larger entries made the foot of a wall 3H deep 15 % too bright).
    double cut_off = 2e-3;
    double closure = 1e-5;  // rows are to sum to 1 − sky − below within this
    int passes = 30;
    std::span<const PassedLight> passed{};  // (material) as RayScene has it; empty: all opaque
    bool sunlight = false;                  // as in FacetViewOptions
};

struct ReciprocityReport {
    std::size_t pairs = 0, left_out = 0;
    double worst_closure = 0.0;  // before what is missing was given to `below`
    int passes = 0;
};

/// Makes sampled view factors (view_factor_sampling.hpp) reciprocal, A_i F_ij = A_j F_ji to float
/// rounding, with each row's sum kept: sky + below + Σ row = 1.
///
/// Of n_i rays of one facet and n_j of the other, h meet: the likeliest exchange area is
/// h / (λ_i/A_i + λ_j/A_j), with λ = n if rows were free, and with the λ that close the rows, since
/// they must (the multipliers of the likelihood's maximum under that constraint; found by fixed
/// point, λ within a factor of 8 of n). So a large facet met by few rays does not bend the rows of
/// the small ones that see it well. A row that cannot be filled (a facet whose few partners are
/// taken by others) leaves its rest to `below`, ground like its own; one that its partners overfill
/// gives up to 0.02 of its sky. Twice as many entries as were sampled at most: memory is linear in
/// the facets, rays per facet × share of ground seen × 16 bytes.
///
/// What is seen in copies' places (FacetViews::copied) keeps its share of the hemisphere and goes
/// into the rows last: light that goes that way does so one way only.
///
/// Ground under a building would meet the walls from behind, and they do not look back: it would
/// lose most of its view to `below`. Scenes have no ground there (scenes/world/world).
ReciprocityReport make_reciprocal(const FacetSet& facets, FacetViews& views,
                                  const ReciprocityOptions& options = {});

}  // namespace diurna
