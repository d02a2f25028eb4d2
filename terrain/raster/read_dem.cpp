#include "terrain/raster/read_dem.hpp"

#include <vector>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_file.hpp"
#include "terrain/raster/dem_mosaic.hpp"
#include "terrain/raster/dem_voids.hpp"
#include "terrain/raster/dem_window.hpp"
#include "terrain/raster/geoid.hpp"
#include "terrain/raster/zero_posts.hpp"

namespace diurna {

namespace {

Dem finished(Dem dem, const DemOptions& options) {
    warn_of_zero_posts(dem);
    apply_void_policy(dem, options.voids);
    if (options.geoid) add_geoid(dem);
    return dem;
}

}  // namespace

Dem read_dem(const std::filesystem::path& file, const DemOptions& options) {
    return finished(read_tile(file, options, false), options);
}

Dem read_dem(std::span<const std::filesystem::path> files, const DemOptions& options) {
    if (files.empty()) throw InputError("elevation", "names no file");
    if (files.size() == 1) return read_dem(files.front(), options);
    std::vector<Dem> tiles;
    for (const auto& file : files) tiles.push_back(read_tile(file, options, true));
    Dem dem = joined(std::move(tiles));
    crop(dem, window_of(dem, options));
    return finished(std::move(dem), options);
}

}  // namespace diurna
