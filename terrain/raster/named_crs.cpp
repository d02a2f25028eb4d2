#include "terrain/raster/named_crs.hpp"

#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

bool is_crs(const std::string& name) {
    if (name.empty()) return true;
    const QuietGdal gdal;
    const OGRSpatialReference reference = reference_of(name);
    if (!reference.IsGeographic() && !reference.IsProjected()) return false;
    return transformation(reference, wgs84()) != nullptr;
}

std::vector<Geodetic> geodetic_of(const std::string& crs, std::span<const Eigen::Vector2d> places) {
    std::vector<Geodetic> found;
    if (crs.empty()) {
        for (const Eigen::Vector2d& at : places) found.push_back({at.x(), at.y(), 0.0});
        return found;
    }
    if (!is_crs(crs)) throw InputError(crs, "is not a coordinate reference system known to PROJ");
    const QuietGdal gdal;
    const GeoProjection& projection = projection_of(crs, crs);
    std::vector<double> x, y;
    for (const Eigen::Vector2d& at : places) {
        x.push_back(projection.geographic ? at.y() : at.x());
        y.push_back(projection.geographic ? at.x() : at.y());
    }
    const std::vector<int> good = transform(*projection.to_geodetic, x, y);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool reached = good[i] && std::isfinite(x[i]) && std::isfinite(y[i]);
        found.push_back({reached ? y[i] : none, reached ? x[i] : none, 0.0});
    }
    return found;
}

}  // namespace diurna
