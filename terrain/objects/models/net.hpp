#pragma once

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Spreads a net over an object: an open sheet, part "net" of material "camouflage_net", that keeps
/// `clearance` [m] above every vertex and falls away from there by one to one, to a hand over the
/// ground.
///
/// edge  [m] of its squares
void add_net(MeshFile& mesh, double clearance, double edge);

}  // namespace diurna
