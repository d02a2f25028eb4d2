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

}  // namespace diurna
