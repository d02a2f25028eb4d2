#pragma once

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Spreads a net over an object: an open sheet, part "net" of material "camouflage_net", at
/// `clearance` [m] above every vertex, falling from there with slope 1:1 to about 10 cm above the
/// ground.
///
/// edge  [m] of its squares
void add_net(MeshFile& mesh, double clearance, double edge);

}  // namespace diurna
