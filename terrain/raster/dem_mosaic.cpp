#include "terrain/raster/dem_mosaic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/geotransform.hpp"

namespace diurna {

namespace {

/// Where a tile's first post lies on the lattice of another.
std::array<int, 2> lattice_place(const Dem& tile, const Dem& first) {
    const auto &a = first.transform, &b = tile.transform;
    const double cell = std::sqrt(std::abs(pixel_area(a)));
    bool same = same_reference(tile.crs_wkt, first.crs_wkt);
    for (const int k : {1, 2, 4, 5}) same = same && std::abs(a[k] - b[k]) < 1e-5 * cell;
    if (!same) {
        throw InputError(tile.source, fmt::format("has another grid than {}", first.source),
                         "convert the tiles to one CRS and spacing, for example with gdalwarp");
    }
    double dx = b[0] - a[0];
    if (projection_of(first.crs_wkt, first.source).geographic) {
        dx -= 360.0 * std::round(dx / 360.0);
    }
    const Eigen::Vector2d place = pixels_along(a, dx, b[3] - a[3]);
    const double column = place.x(), row = place.y();
    if (!(std::abs(column) < 1e6 && std::abs(row) < 1e6) ||
        std::abs(column - std::round(column)) > 0.01 || std::abs(row - std::round(row)) > 0.01) {
        throw InputError(tile.source,
                         fmt::format("its posts are between those of {}", first.source));
    }
    return {static_cast<int>(std::round(column)), static_cast<int>(std::round(row))};
}

/// Posts on which a tile differs from those before it.
struct Seam {
    std::size_t differing = 0;
    float worst = 0.0f;  // [m]
};

/// Heights of a tile at its place in the mosaic, where no tile has been before.
Seam lay_down(const Dem& tile, int first_column, int first_row, Dem& mosaic) {
    Seam seam;
    for (int row = 0; row < tile.rows; ++row) {
        float* to = mosaic.height.data() + std::size_t(row + first_row) * mosaic.columns +
                    std::size_t(first_column);
        for (int column = 0; column < tile.columns; ++column) {
            const float h = tile.at(row, column);
            if (std::isnan(to[column])) {
                to[column] = h;
            } else if (std::abs(h - to[column]) > 1.0f) {
                ++seam.differing;
                seam.worst = std::max(seam.worst, std::abs(h - to[column]));
            }
        }
    }
    return seam;
}

}  // namespace

Dem joined(std::vector<Dem> tiles) {
    std::vector<std::array<int, 2>> place;
    std::array<int, 2> low{0, 0}, high{0, 0};
    for (const Dem& tile : tiles) {
        place.push_back(lattice_place(tile, tiles.front()));
        const int last[] = {place.back()[0] + tile.columns, place.back()[1] + tile.rows};
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], place.back()[k]);
            high[k] = std::max(high[k], last[k]);
        }
    }
    Dem dem;
    dem.source = tiles.front().source;
    dem.crs_wkt = tiles.front().crs_wkt;
    dem.transform = shifted(tiles.front().transform, low[0], low[1]);
    dem.columns = high[0] - low[0];
    dem.rows = high[1] - low[1];
    if (double(dem.columns) * dem.rows > most_posts) {
        throw InputError(
            dem.source, fmt::format("its tiles span {} x {} posts, expected at most {:.0f} million",
                                    dem.columns, dem.rows, most_posts / 1e6));
    }
    dem.height.assign(std::size_t(dem.columns) * dem.rows, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        Dem& tile = tiles[i];
        const Seam seam = lay_down(tile, place[i][0] - low[0], place[i][1] - low[1], dem);
        dem.notes.insert(dem.notes.end(), tile.notes.begin(), tile.notes.end());
        dem.warnings.insert(dem.warnings.end(), tile.warnings.begin(), tile.warnings.end());
        if (seam.differing > 0) {
            dem.notes.push_back(
                fmt::format("{}: {} shared with other tiles with differences up to {:.1f} m; those "
                            "of the first tile are used",
                            tile.source, number_of(seam.differing, "post"), seam.worst));
        }
        tile.height = {};
    }
    return dem;
}

}  // namespace diurna
