#pragma once

#include <filesystem>
#include <span>

#include "render/picture/colour_scale.hpp"
#include "scenes/export/run_heat.hpp"
#include "scenes/input/scene.hpp"

namespace diurna {

/// Writes a KMZ: a ground overlay (OGC KML 2.2) for each instant, from it to the next one, a lone
/// one for an hour, with a picture of the ground's temperatures. Pixels lie on latitude and
/// longitude, as many as the raster has posts there but 2048 a side at most; each has the colour of
/// the nearest post of heat_raster.hpp, on one scale [°C] that the document's description reports
/// and that is returned; none where there is no ground.
///
/// Throws InputError where the scene is not the run's, no post has ground, or it lies across the
/// date line; std::runtime_error where it cannot be written.
ColourScale write_kmz(const std::filesystem::path& file, const RunHeat& heat, const Scene& scene,
                      std::span<const Instant> instants);

}  // namespace diurna
