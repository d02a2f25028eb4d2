#pragma once

#include <span>
#include <string>

#include "render/light/band_light.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Adds the sunlight that the air scatters before what every pixel sees to a plane [W m⁻² sr⁻¹].
/// Directions are those of the pixels' middles; a pixel whose sightings lie within 3 % of range is
/// looked up once, at their mean. Returns what the table was like, for the frame's notes.
///
/// - band: with scattered sunlight
std::string add_scattered_paths(const View& view, const Observer& observer,
                                const RadianceInput& input, const BandLight& band,
                                std::span<float> plane);

}  // namespace diurna
