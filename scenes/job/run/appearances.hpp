#pragma once

#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/view/adaptive.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Criteria by which adaptive sampling selects pixels: at up to four evenly chosen instants of the
/// frames, the facets' apparent temperature in each thermal band (thermal_appearance), and by day
/// their sunlight in each band below 3 µm, 100 K for a white facet that faces the sun. From all
/// frames of a view, including those already rendered, so that a resumed run has the same pictures.
std::vector<Appearance> appearances(const Prepared& prepared, std::span<const Instant> frames,
                                    const FacetViews& views, const TemperatureField& field,
                                    std::span<const Band> bands);

/// Gives all levels of a texture in a facet's place its appearance: what a sample sees there is a
/// mixture of them already.
void without_textures(const TextureLevels& levels, Appearance& look);

}  // namespace diurna
