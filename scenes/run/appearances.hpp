#pragma once

#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/view/adaptive.hpp"
#include "scenes/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// What adaptive sampling is to tell hard pixels by: at up to four of the frames' instants, evenly
/// chosen, the facets' heat in each thermal band (thermal_appearance), and by day their sunlight in
/// each band below 3 µm, 100 K for a white facet that faces the sun. Of all frames of a view,
/// whichever are still to be rendered, so that a run taken up again looks alike.
std::vector<Appearance> appearances(const Prepared& prepared, std::span<const Instant> frames,
                                    const FacetViews& views, const TemperatureField& field,
                                    std::span<const Band> bands);

}  // namespace diurna
