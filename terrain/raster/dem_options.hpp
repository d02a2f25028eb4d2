#pragma once

#include <optional>

#include "materials/base/confines.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Treatment of voids: the file is refused, they stay as holes in the mesh, or they are filled
/// smoothly from the posts around (averages of ever coarser grids, the finest that has a value).
enum class VoidPolicy { refuse, leave, fill };

struct DemOptions {
    VoidPolicy voids = VoidPolicy::refuse;
    /// Keep only the window of posts that contains the circle of this radius [m] around a place;
    /// nullopt: the whole raster.
    std::optional<Geodetic> centre = std::nullopt;
    double radius = 0.0;
    /// Metres per unit of the file's heights; nullopt: the file's unit, metres if it has none.
    std::optional<double> unit = std::nullopt;
    /// Adds EGM96's geoid, which converts heights above the sea to heights above the ellipsoid.
    bool geoid = false;
    /// Folders of files that the raster refers to, mainly sidecars; nullopt: its own folder.
    std::optional<Confines> confines = std::nullopt;
};

}  // namespace diurna
