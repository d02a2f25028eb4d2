#pragma once

#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Radiance of a facet at its viewing angle, without reflected and transmitted images of other
/// things: for panes, nets, mirrors, and any finish that depends on angle.
///
/// - target: of the secondary ray, index into SecondaryTables::facet
/// - out: (row, lane), the rows those of sent_rows
void directional_light(const SecondaryTables& tables, const SecondaryRay& secondary,
                       std::uint32_t target, float* out);

}  // namespace diurna
