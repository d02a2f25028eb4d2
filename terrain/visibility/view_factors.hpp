#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// Facet-to-facet view factors in compressed rows: facet f sees facet[k] with factor[k] for k in
/// [row[f], row[f+1]). A row sums to 1 − sky(f) (− what falls below the terrain's edge).
struct ViewFactors {
    std::vector<std::uint32_t> row;  // size() + 1
    std::vector<FacetId> facet;
    std::vector<float> factor;
};

/// A facet's shares of the functions of sky_basis.hpp but the first, of which it is the sky view.
using SkyShares = std::array<float, 15>;

/// What each facet sees through its own hemisphere, cosine-weighted about its own normal.
/// `sky` + Σ row of `others` + `below` = 1, where `below` is what leaves the scene's edge under
/// the horizontal: far ground not modelled, to be taken as ground like the facet's own
/// surroundings. Where closed meshes of thin plates are seen from inside, so is `hidden`: as warm
/// as the facet itself, without sunlight. `shares` tell where in the sky it is open. Sampled by
/// view_factor_sampling.hpp, made reciprocal by reciprocity.hpp.
struct FacetViews {
    std::vector<float> sky;    // 0 to 1: the sky view factor
    std::vector<float> below;  // 0 to 1
    ViewFactors others;
    std::vector<float> hidden = {};        // 0 to 1, by the backs of sheets; empty: none
    std::vector<std::uint16_t> rays = {};  // (facet) that this comes from; empty: as many of each
    std::vector<SkyShares> shares = {};    // (facet); empty: as behind a ring of one height
    /// (facet) 1 where it lies below the ground: it sees what is found to see it (reciprocity.hpp),
    /// and else is `hidden`. Empty: none, and once rows are reciprocal.
    std::vector<std::uint8_t> buried = {};
    /// What is seen in copies' places (copies.hpp), by the facets that are copied. These do not
    /// look back: apart from `others` until reciprocity.hpp has made those reciprocal and adds
    /// this; no rows: none.
    ViewFactors copied = {};
};

}  // namespace diurna
