#include "scenes/world/elevation.hpp"

#include <filesystem>
#include <vector>

#include "terrain/raster/read_dem.hpp"

namespace diurna {

Dem elevation_of(const Scene& scene) {
    std::vector<std::filesystem::path> tiles{scene.terrain.elevation};
    tiles.insert(tiles.end(), scene.terrain.tiles.begin(), scene.terrain.tiles.end());
    return read_dem(tiles, scene.terrain.reading);
}

}  // namespace diurna
