#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/light/radiance.hpp"
#include "render/path/background_table.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// What is seen where the scene ends, per band, over the directions in which some pixel sees it.
/// Empty if none does.
///
/// scattered  (band) scattered_sun()
std::vector<BackgroundTable> backgrounds(const View& view, const Observer& observer,
                                         std::span<const Band> bands, const RadianceInput& input,
                                         std::span<const std::optional<SunField>> scattered);

/// Azimuth of the optical axis counted from the sun's [deg].
double axis_from_sun_deg(const Observer& observer, const RadianceInput& input);

}  // namespace diurna
