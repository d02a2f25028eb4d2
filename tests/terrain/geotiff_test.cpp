#include "terrain/raster/geotiff.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

TEST_CASE("what is written in a raster's place is read back there", "[terrain][raster_file]") {
    const ScratchFolder folder("raster");
    const Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    std::vector<float> half(dem.height.size());
    for (std::size_t i = 0; i < half.size(); ++i) half[i] = 0.5f * dem.height[i];
    write_geotiff(folder.path / "half.tif", dem, {{"half", half}});
    const Dem back = read_dem(folder.path / "half.tif");
    CHECK(back.columns == dem.columns);
    CHECK(back.rows == dem.rows);
    CHECK(back.height == half);
    CHECK(back.transform == dem.transform);
    CHECK(height_at(back, 36.32, -84.2) == Approx(0.5 * height_at(dem, 36.32, -84.2)));
}

TEST_CASE("posts without a value are voids", "[terrain][raster_file]") {
    const ScratchFolder folder("raster");
    const Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    std::vector<float> value = dem.height;
    value[7] = std::nanf("");
    write_geotiff(folder.path / "hole.tif", dem, {{"hole", value}});
    CHECK(read_dem(folder.path / "hole.tif", {.voids = VoidPolicy::leave}).voids == 1);
}
