#pragma once

#include <optional>

#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// The scene's materials as pictures of an instant need them where reflected sunlight was measured:
/// those below the sensor (scenes/job/world/measured_albedo.hpp) reflect the share of sunlight that
/// the heat balance takes, with their spectrum moved evenly towards black or white up to 3 µm
/// (with_albedo()). None: all are as they are.
std::optional<MaterialLibrary> measured_materials(const Prepared& prepared, Instant instant);

}  // namespace diurna
