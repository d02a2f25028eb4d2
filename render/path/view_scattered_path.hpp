#pragma once

#include <span>
#include <string>

#include "render/light/band_light.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Adds the sunlight scattered by the air in front of each pixel's surfaces to a plane [W m⁻²
/// sr⁻¹]. Directions are those of the pixels' centres; a pixel with surfaces within 3 % of
/// range is evaluated once, at their mean. Returns the table's size and error, for the frame's
/// notes.
///
/// - band: with scattered sunlight
std::string add_scattered_paths(const View& view, const Observer& observer,
                                const RadianceInput& input, const BandLight& band,
                                std::span<float> plane);

}  // namespace diurna
