#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/inputs.hpp"
#include "terrain/place/instant.hpp"

/// Cache keys of stages, from all their inputs (SHA-256; with this program's sources): the same
/// key, the same bytes.
namespace diurna {

/// Key of visibility, from everything that blocks light: triangles and their
/// transmittance, the raster's relief, sampling options. Independent of materials' colours
/// and weather.
std::string visibility_key(const Prepared& prepared);

/// Key of the facets' view factors (scenes/job/run/scene_sky_view.hpp).
std::string sky_key(const Prepared& prepared, bool sunlight);

/// Key of the sunlit shares at some instants.
///
/// - asked: (facet) as in DailySunExposure::ask_for
std::string sun_key(const Prepared& prepared, const std::vector<Instant>& instants,
                    std::span<const std::uint8_t> asked);

/// Key of the temperatures of a scene that is unchanged since it was read, for any stored instants:
/// from the content of what the heat balance takes (scenes/job/store/heat_content.hpp). If pictures
/// determine what is solved (tolerance_K), the scene file except tables used only by pictures, all
/// other inputs, and the pictures' poses and instants are included; if objects move, the whole file.
///
/// - inputs: of the run
/// - tolerance: [K] of the solution (scenes/job/run/heat.hpp)
std::string heat_key(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     double tolerance);

}  // namespace diurna
