#include "terrain/raster/dem_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotransform.hpp"

namespace diurna {

namespace {

/// Least and most of latitude and longitude of a raster's border [°].
struct Reach {
    double south = 90.0, north = -90.0, west = 180.0, east = -180.0;

    bool has(double latitude, double longitude) const {
        return latitude >= south && latitude <= north && longitude >= west && longitude <= east;
    }
};

Reach reach_of(const Dem& dem) {
    std::vector<Eigen::Vector2d> corner;
    for (const double y : {0.0, 0.5, 1.0}) {
        for (const double x : {0.0, 0.5, 1.0}) {
            corner.emplace_back(x * (dem.columns - 1), y * (dem.rows - 1));
        }
    }
    const std::vector<float> height(corner.size(), 0.0f);
    Reach reach;
    for (const Geodetic& at : geodetic_places(dem, corner, height)) {
        reach.south = std::min(reach.south, at.latitude_deg);
        reach.north = std::max(reach.north, at.latitude_deg);
        reach.west = std::min(reach.west, at.longitude_deg);
        reach.east = std::max(reach.east, at.longitude_deg);
    }
    return reach;
}

/// Throws InputError that reports how far the raster reaches, and what may be wrong with the place.
[[noreturn]] void refuse_place(const Dem& dem, double latitude, double longitude) {
    const Reach reach = reach_of(dem);
    std::string hint = "site.latitude_deg is positive north, longitude_deg positive east";
    if (reach.has(longitude, latitude)) {
        hint = "site.latitude_deg and longitude_deg may be exchanged";
    } else if (reach.has(latitude, -longitude) || reach.has(-latitude, longitude) ||
               reach.has(-latitude, -longitude)) {
        hint =
            "a sign may be missing: site.longitude_deg is negative west of Greenwich, latitude_deg "
            "negative south of the equator";
    }
    throw InputError(
        dem.source,
        fmt::format("does not contain the place {:.5f}, {:.5f}: it covers latitudes {:.5f} to "
                    "{:.5f}, longitudes {:.5f} to {:.5f}",
                    latitude, longitude, reach.south, reach.north, reach.west, reach.east),
        hint);
}

}  // namespace

PostWindow window_of(const Dem& dem, const DemOptions& options) {
    if (!options.centre) return {0, 0, dem.columns, dem.rows};
    const Site site{options.centre->latitude_deg, options.centre->longitude_deg, 0.0};
    std::vector<Geodetic> circle;
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
        circle.push_back(to_geodetic(site, options.radius * direction(azimuth_deg, 0.0)));
    }
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low;
    for (const Eigen::Vector2d& place : raster_places(dem, circle)) {
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    const auto clip = [](double x, int count) {
        return static_cast<int>(std::clamp(x, 0.0, count - 1.0));
    };
    const int first_column = clip(std::floor(low.x()) - 1.0, dem.columns);
    const int first_row = clip(std::floor(low.y()) - 1.0, dem.rows);
    const int last_column = clip(std::ceil(high.x()) + 1.0, dem.columns);
    const int last_row = clip(std::ceil(high.y()) + 1.0, dem.rows);
    if (!low.allFinite() || !high.allFinite() || last_column - first_column < 1 ||
        last_row - first_row < 1) {
        refuse_place(dem, site.latitude_deg, site.longitude_deg);
    }
    return {first_column, first_row, last_column - first_column + 1, last_row - first_row + 1};
}

void move_to_window(Dem& dem, const PostWindow& window) {
    dem.transform = shifted(dem.transform, window.column, window.row);
    dem.columns = window.columns;
    dem.rows = window.rows;
}

void crop(Dem& dem, const PostWindow& window) {
    const auto crop_one = [&](auto& value) {
        std::remove_reference_t<decltype(value)> kept;
        kept.reserve(std::size_t(window.columns) * window.rows);
        for (int row = 0; row < window.rows; ++row) {
            const auto from =
                value.begin() + window.column + std::ptrdiff_t(row + window.row) * dem.columns;
            kept.insert(kept.end(), from, from + window.columns);
        }
        value = std::move(kept);
    };
    crop_one(dem.height);
    if (!dem.is_void.empty()) crop_one(dem.is_void);
    move_to_window(dem, window);
}

}  // namespace diurna
