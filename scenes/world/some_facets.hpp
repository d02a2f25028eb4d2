#pragma once

#include <cstdint>
#include <span>

#include "terrain/facets.hpp"

namespace diurna {

/// Some of all facets, in that order, as a set of their own; none shares a corner with another.
FacetSet some_facets(const FacetSet& all, std::span<const std::uint32_t> facet);

}  // namespace diurna
