#pragma once

#include "render/light/radiance_terms.hpp"
#include "render/rays/hop_tables.hpp"

namespace diurna {

/// The terms a surface sends by itself: all but the path's.
inline constexpr std::size_t own_terms = term_count - 1;

/// What a facet sends at the angle it is seen at, but for what it mirrors of other things and lets
/// through: of pane, net, mirror, or any finish whose light depends on angle.
///
/// - target: of the hop, index into HopTables::facet
/// - out: (term, lane)
void directional_light(const HopTables& tables, const Hop& hop, std::uint32_t target, float* out);

}  // namespace diurna
