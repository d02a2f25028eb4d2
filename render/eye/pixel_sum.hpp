#pragma once

#include <span>
#include <vector>

#include "render/eye/eye_table.hpp"
#include "render/path/background_table.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Weighted sums over a pixel's visible facets, for several bands or terms (columns) at a time.
///
/// - eye: (target, column)
/// - background: (column) radiance where the scene ends; null: none
/// - azimuth_deg: of the optical axis, relative to the sun's
/// - planes: (column)(pixel), output
void sum_pixels(const View& view, std::span<const AtEye> eye,
                std::span<const BackgroundTable* const> background, double azimuth_deg,
                std::span<std::vector<float>> planes);

}  // namespace diurna
