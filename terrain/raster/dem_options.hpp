#pragma once

#include <optional>

#include "materials/base/confines.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// What becomes of voids: the file is refused, they stay as holes in the mesh, or they are filled
/// smoothly from the posts around (averages of coarser and coarser grids, the finest that knows).
enum class VoidPolicy { refuse, leave, fill };

struct DemOptions {
    VoidPolicy voids = VoidPolicy::refuse;
    /// Keep only the window of posts that holds the circle of this radius [m] round a place; none:
    /// the whole raster.
    std::optional<Geodetic> centre = std::nullopt;
    double radius = 0.0;
    /// Metres per unit of the file's heights; none: as the file says, metres if it says nothing.
    std::optional<double> unit = std::nullopt;
    /// Adds EGM96's geoid, so that heights above the sea become heights above the ellipsoid.
    bool geoid = false;
    /// Where what the raster leads to may lie, sidecars above all; none: those of its own folder.
    std::optional<Confines> confines = std::nullopt;
};

}  // namespace diurna
