#pragma once

#include <filesystem>
#include <vector>

#include "materials/base/section.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// A finer raster of part of the ground (terrain/ground/dem_detail.hpp).
struct DetailInput {
    std::vector<std::filesystem::path> files;  // the second and further: tiles on the same lattice
    DemOptions reading;
    double tolerance = 1.0;  // vertical [m]
    double blend = 20.0;     // strip within its border [m]
};

/// The keys for a raster: voids, height_unit, vertical_datum.
///
/// - geoid: default for vertical_datum
DemOptions read_posts(const Section& section, bool geoid);

/// The tables [[terrain.detail]]; mistakes are noted in the section.
///
/// - tolerance: [m] default
/// - geoid: whether [terrain] converts heights above the sea to heights above the ellipsoid
std::vector<DetailInput> read_details(const Section& terrain, double tolerance, bool geoid);

}  // namespace diurna
