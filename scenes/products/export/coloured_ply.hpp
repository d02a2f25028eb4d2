#pragma once

#include <filesystem>

#include "render/picture/colour_scale.hpp"
#include "scenes/products/export/run_heat.hpp"

namespace diurna {

/// The triangles at one instant as PLY (binary), each with its temperature [K] and a colour of the
/// pictures' scale (1st to 99th percentile of the facets, whole degrees); vertices are east, north,
/// up [m] of the site; comments state this and the scale. Returns the scale [°C]. Throws
/// std::runtime_error if it cannot be written.
ColourScale write_coloured_ply(const std::filesystem::path& file, const RunHeat& heat,
                               const HeatAt& at);

}  // namespace diurna
