#pragma once

#include <filesystem>
#include <span>

#include "render/picture/colour_scale.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/products/export/run_heat.hpp"

namespace diurna {

/// Writes a KMZ: a ground overlay (OGC KML 2.2) for each instant, valid until the next one (a
/// single one for an hour), with a picture of the ground's temperatures. Pixels are on a grid of
/// latitude and longitude, with the raster's number of posts but at most 2048 a side; each has the
/// colour of the nearest post of heat_raster.hpp, on one scale [°C], which is in the document's
/// description and is returned; transparent without ground.
///
/// Throws InputError if the scene is not the run's, no post has ground, or it crosses the date
/// line; std::runtime_error if it cannot be written.
ColourScale write_kmz(const std::filesystem::path& file, const RunHeat& heat, const Scene& scene,
                      std::span<const Instant> instants);

}  // namespace diurna
