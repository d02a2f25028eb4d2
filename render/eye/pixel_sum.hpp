#pragma once

#include <span>
#include <vector>

#include "render/eye/eye_table.hpp"
#include "render/path/background_table.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Sums of a pixel's sightings, of several bands or terms (columns) at a time.
///
/// - eye: (target, column)
/// - background: (column) what is seen where the scene ends; null: nothing
/// - azimuth_deg: of the optical axis, counted from the sun's
/// - planes: (column)(pixel), written
void sum_pixels(const View& view, std::span<const AtEye> eye,
                std::span<const BackgroundTable* const> background, double azimuth_deg,
                std::span<std::vector<float>> planes);

}  // namespace diurna
