#include "terrain/raster/geoid.hpp"

#include <ogr_spatialref.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/grid.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

std::vector<double> geoid_heights(std::span<const Geodetic> places) {
    const QuietGdal gdal;
    // Made once per thread: places on trajectories are requested one by one.
    thread_local const Transformation shift =
        transformation(reference_of("EPSG:4326+5773"), reference_of("EPSG:4979"));
    if (!shift) throw InputError("EGM96", "PROJ has no transformation from it to the ellipsoid");
    std::vector<double> x, y, z(places.size(), 0.0);
    for (const Geodetic& place : places) {
        x.push_back(place.longitude_deg);
        y.push_back(place.latitude_deg);
    }
    std::vector<int> good(places.size(), 1);
    shift->Transform(static_cast<int>(places.size()), x.data(), y.data(), z.data(), good.data());
    // Without the grid PROJ would leave every height as it is.
    if (!places.empty() && (std::find(good.begin(), good.end(), 0) != good.end() ||
                            std::all_of(z.begin(), z.end(), [](double h) { return h == 0.0; }))) {
        throw InputError("EGM96", "PROJ lacks the grid egm96_15 for this area",
                         "apt install proj-data");
    }
    return z;
}

void add_geoid(Dem& dem) {
    const Eigen::Vector2d spacing = post_spacing(dem);
    const int step = std::clamp(static_cast<int>(1000.0 / spacing.minCoeff()), 1, 64);
    const int columns = (dem.columns - 1) / step + 2, rows = (dem.rows - 1) / step + 2;
    std::vector<Eigen::Vector2d> node;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) node.emplace_back(x * step, y * step);
    }
    const std::vector<float> level(node.size(), 0.0f);
    const std::vector<double> geoid = geoid_heights(geodetic_places(dem, node, level));
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) {
            const double u = double(column % step) / step, v = double(row % step) / step;
            const double* a = geoid.data() + std::size_t(row / step) * columns + column / step;
            const double* b = a + columns;
            dem.height[std::size_t(row) * dem.columns + column] +=
                static_cast<float>(bilinear(a[0], a[1], b[0], b[1], u, v));
        }
    }
}

}  // namespace diurna
