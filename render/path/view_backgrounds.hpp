#pragma once

#include <span>
#include <vector>

#include "render/path/background_table.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Background beyond the scene, per band, over the directions in which some pixel sees it. Empty if
/// none does.
std::vector<BackgroundTable> view_backgrounds(const View& view, const Observer& observer,
                                              std::span<const BandLight> bands,
                                              const RadianceInput& input);

/// Azimuth of the optical axis relative to the sun's [deg].
double axis_from_sun_deg(const Observer& observer, const RadianceInput& input);

}  // namespace diurna
