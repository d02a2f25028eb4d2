#pragma once

#include <Eigen/Core>
#include <array>

namespace diurna {

/// GDAL's affine transform from fractional pixels (column, row), 0, 0 the outer corner of the
/// first, to the map's x and y: x = t0 + t1 column + t2 row, y = t3 + t4 column + t5 row.
using GeoTransform = std::array<double, 6>;

/// Signed area of a pixel on the map; negative where rows run south and columns east.
inline double pixel_area(const GeoTransform& t) { return t[1] * t[5] - t[2] * t[4]; }

inline Eigen::Vector2d map_place(const GeoTransform& t, const Eigen::Vector2d& pixel) {
    return {t[0] + t[1] * pixel.x() + t[2] * pixel.y(), t[3] + t[4] * pixel.x() + t[5] * pixel.y()};
}

/// Pixels across and down for an offset (dx, dy) on the map from the first pixel's corner.
inline Eigen::Vector2d pixels_along(const GeoTransform& t, double dx, double dy) {
    const double area = pixel_area(t);
    return {(t[5] * dx - t[2] * dy) / area, (t[1] * dy - t[4] * dx) / area};
}

inline Eigen::Vector2d pixel_at(const GeoTransform& t, double x, double y) {
    return pixels_along(t, x - t[0], y - t[3]);
}

/// The transform of a part of the raster, beginning this number of pixels across and down.
inline GeoTransform shifted(GeoTransform t, double columns, double rows) {
    t[0] += t[1] * columns + t[2] * rows;
    t[3] += t[4] * columns + t[5] * rows;
    return t;
}

}  // namespace diurna
