#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// View factors in compressed rows: facet f sees facet[k] with factor[k] for k in
/// [row[f], row[f+1]). Both are plain numbers in one set: the facets that rays meet, or after
/// for_all_levels() (texture/level_values.hpp) the surfaces. A row sums to 1 − sky(f) − the share
/// below the terrain's edge.
struct ViewFactors {
    std::vector<std::uint32_t> row;  // size() + 1
    std::vector<std::uint32_t> facet;
    std::vector<float> factor;
};

/// A facet's shares of the functions of sky_basis.hpp without the first, which is the sky view.
using SkyShares = std::array<float, 15>;

/// View of each facet's hemisphere, cosine-weighted about its normal. `sky` + Σ row of `others` +
/// `below` = 1, where `below` is the share outside the scene's edge under the horizontal: far
/// ground that is not modelled, treated as ground like the facet's surroundings. Inside closed
/// meshes of thin plates there is also `hidden`: surroundings at the facet's own temperature,
/// without sunlight. `shares` describe the directions of the open sky. Sampled by
/// view_factor_sampling.hpp, made reciprocal by reciprocity.hpp.
struct FacetViews {
    std::vector<float> sky;    // 0 to 1: the sky view factor
    std::vector<float> below;  // 0 to 1
    ViewFactors others;
    std::vector<float> hidden = {};        // 0 to 1, by the backs of sheets; empty: none
    std::vector<std::uint16_t> rays = {};  // (facet) number of rays; empty: all the same
    std::vector<SkyShares> shares = {};    // (facet); empty: as plane_behind_ring()
    /// (facet) 1 if it is below the ground: it sees only facets that see it (reciprocity.hpp), and
    /// the rest is `hidden`. Empty: none, and after reciprocity.
    std::vector<std::uint8_t> buried = {};
    /// Views of copies (copies.hpp), by original facet. Copies do not see back: separate from
    /// `others` until reciprocity.hpp has made those reciprocal and adds these; no rows:
    /// none.
    ViewFactors copied = {};
};

}  // namespace diurna
