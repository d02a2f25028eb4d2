#include "terrain/ground/affordable_tin.hpp"

#include <fmt/format.h>

#include "materials/base/error.hpp"
#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/triangulate.hpp"

namespace diurna {

Tin affordable_tin(const Dem& dem, double tolerance) {
    // Measured with `diurna mesh`: the program and its libraries, what is held and checked for each
    // post of the raster and of a finished grid.
    constexpr double program = 70e6, a_post = 10.0, a_grid_post = 65.0;
    const auto posts = static_cast<double>(dem.height.size());
    const double room = 10.0 * 2.0 * posts + 200e6 - program - a_post * posts;
    if (auto network = triangulate_within(dem, tolerance, room)) return std::move(*network);
    const double valid = posts - static_cast<double>(dem.voids);
    if (valid * a_grid_post <= room) return full_grid(dem);
    throw InputError(dem.source,
                     fmt::format("a mesh with tolerance {:g} m does not fit into {:.0f} MB",
                                 tolerance, 1e-6 * (20.0 * posts + 200e6)),
                     "use a coarser tolerance, or a part of the raster");
}

}  // namespace diurna
