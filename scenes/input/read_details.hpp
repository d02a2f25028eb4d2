#pragma once

#include <filesystem>
#include <vector>

#include "materials/base/section.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// A finer model of part of the ground (terrain/ground/dem_detail.hpp).
struct DetailInput {
    std::vector<std::filesystem::path> files;  // the second and further: tiles of its lattice
    DemOptions reading;
    double tolerance = 1.0;  // vertical [m]
    double blend = 20.0;     // strip within its border [m]
};

/// The keys that say how a raster is to be taken: voids, height_unit, vertical_datum.
///
/// - geoid: where vertical_datum does not say
DemOptions read_posts(const Section& section, bool geoid);

/// The tables [[terrain.detail]]; mistakes are noted in the section.
///
/// - tolerance: [m] of those that name none
/// - geoid: whether [terrain] has its heights above the sea made those above the ellipsoid
std::vector<DetailInput> read_details(const Section& terrain, double tolerance, bool geoid);

}  // namespace diurna
