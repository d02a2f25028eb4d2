#pragma once

#include <span>
#include <vector>

#include "render/eye/eye_tables.hpp"
#include "render/view/linear_facets.hpp"

namespace diurna {

/// Adds the emission of ground that is warmer or colder than its facet's mean where a pixel sees
/// it. Emission is taken as linear in temperature up to 0.5 K from the mean, and as the parabola
/// through three temperatures beyond: within 8 mK of apparent temperature up to 5 K
/// (tests/render/linear_facets_test.cpp). Differences below 1 mK are skipped.
///
/// - planes: (column)(pixel), columns as of the tables
void add_linear_facets(const View& view, const LinearFacets& ground, const SceneLight& light,
                       const EyeTables& tables, std::span<std::vector<float>> planes);

}  // namespace diurna
