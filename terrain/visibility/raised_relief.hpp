#pragma once

#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/relief/height_field.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

/// A relief with all objects filled up to their tops: every post around a cell that an object's
/// box touches, and one further post, is raised to its top. It shades all that an object may
/// shade.
struct RaisedRelief {
    HeightField relief;
    std::vector<std::uint8_t> touched;  // (post) 1 under an object
};

/// Objects are the facets from `ground_facets` on, and copies.
RaisedRelief raised_relief(const FacetSet& facets, const HeightField& relief,
                           std::size_t ground_facets, const Copies& copies = {});

}  // namespace diurna
