#pragma once

#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// What a facet sends at the angle it is seen at, but for what it mirrors of other things and lets
/// through: of pane, net, mirror, or any finish whose light depends on angle.
///
/// - target: of the secondary ray, index into SecondaryTables::facet
/// - out: (row, lane), the rows those of sent_rows
void directional_light(const SecondaryTables& tables, const SecondaryRay& secondary,
                       std::uint32_t target, float* out);

}  // namespace diurna
