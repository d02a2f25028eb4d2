#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenes/cache/inputs.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/place/instant.hpp"

/// Names for what stages find, by what they are made of (SHA-256; of this program's sources, too):
/// the same key, the same bytes.
namespace diurna {

/// Of all that stands in the way of light, by its content: triangles in their places and what goes
/// through them, the raster's relief, how finely it is sampled. Paints and weather are not in it.
std::string visibility_key(const Prepared& prepared);

/// Of what facets see (scenes/run/scene_sky_view.hpp).
std::string sky_key(const Prepared& prepared, bool sunlight);

/// Of the sun's shares at some instants.
///
/// - asked: (facet) as DailySunExposure::ask_for has it
std::string sun_key(const Prepared& prepared, const std::vector<Instant>& instants,
                    std::span<const std::uint8_t> asked);

/// Of the temperatures of a scene that nothing was changed of since it was read, whenever they are
/// kept: by what its file says but for the tables that nothing but pictures is made of, the content
/// of all other inputs, and what stands where. Where pictures decide what is solved (tolerance_K),
/// and where objects go, these tables count.
///
/// - inputs: of the run
/// - tolerance: [K] that it is solved to (scenes/run/heat.hpp)
std::string heat_key(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     double tolerance);

}  // namespace diurna
