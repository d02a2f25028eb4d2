#include "scenes/world/elevation.hpp"

#include <filesystem>
#include <vector>

#include "terrain/ground/dem_detail.hpp"
#include "terrain/raster/read_dem.hpp"

namespace diurna {

Dem elevation_of(const Scene& scene) {
    std::vector<std::filesystem::path> tiles{scene.terrain.elevation};
    tiles.insert(tiles.end(), scene.terrain.tiles.begin(), scene.terrain.tiles.end());
    Dem dem = read_dem(tiles, scene.terrain.reading);
    for (const DetailInput& detail : scene.terrain.details) {
        lay_detail(dem, read_dem(detail.files, detail.reading),
                   {.tolerance = detail.tolerance, .blend = detail.blend});
    }
    return dem;
}

}  // namespace diurna
