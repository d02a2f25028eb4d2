#pragma once

#include <cstddef>

#include "terrain/facets.hpp"
#include "terrain/visibility.hpp"

namespace diurna {

struct ReciprocityOptions {
    /// A pair is left out where neither sees more of the other than this. Its share goes to the
    /// facet's other partners.
    double cut_off = 1e-3;
    double closure = 1e-5;  // rows are to sum to 1 − sky − below within this
    int passes = 30;
};

struct ReciprocityReport {
    std::size_t pairs = 0, left_out = 0;
    double worst_closure = 0.0;  // before what is missing was given to `below`
    int passes = 0;
};

/// Makes sampled view factors reciprocal, A_i F_ij = A_j F_ji to float rounding, with each row's
/// sum kept: sky + below + Σ row = 1.
///
/// From n_i and n_j rays the likeliest exchange area of a pair is
/// (n_i F_ij + n_j F_ji) / (n_i/A_i + n_j/A_j); a symmetric scaling d_i d_j then restores the rows
/// (Sinkhorn 1967). A row that no scaling can fill (a facet whose few partners are taken by others)
/// leaves its rest to `below`, ground like its own: 0.006 of the hemisphere on the sample scene's
/// gentle relief, where a facet sees 0.03 of ground and has met it with two of its 64 rays. Twice
/// as many entries as were sampled at most: memory is linear in the facets, rays per facet × share
/// of ground seen × 16 bytes.
///
/// Ground under a building meets the walls from behind, and they do not look back: such facets lose
/// most of their exchange to `below` (0.42 to 0.94 on the eight under the sample scene's hangar, no
/// other loses more than 0.3).
ReciprocityReport make_reciprocal(const FacetSet& facets, SkyView& view,
                                  const ReciprocityOptions& options = {});

}  // namespace diurna
