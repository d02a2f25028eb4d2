#pragma once

#include <cstdint>
#include <span>

#include "terrain/facets.hpp"

namespace diurna {

/// A selection of facets, in that order, as a separate set without common corners.
FacetSet some_facets(const FacetSet& all, std::span<const std::uint32_t> facet);

}  // namespace diurna
