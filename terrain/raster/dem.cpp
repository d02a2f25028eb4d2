#include "terrain/raster/dem.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_parts.hpp"
#include "terrain/raster/dem_voids.hpp"

namespace diurna {

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
        throw InputError(dem.source, fmt::format("does not reach the place {:.5f}, {:.5f}",
                                                 site.latitude_deg, site.longitude_deg));
    }
    return {first_column, first_row, last_column - first_column + 1, last_row - first_row + 1};
}

namespace {

void apply_void_policy(Dem& dem, VoidPolicy policy) {
    dem.voids = static_cast<std::size_t>(
        std::count_if(dem.height.begin(), dem.height.end(), [](float h) { return std::isnan(h); }));
    if (dem.voids == dem.height.size()) {
        throw InputError(dem.source, "has no elevation at all: every post is void");
    }
    if (dem.voids > 0) {
        dem.is_void.resize(dem.height.size());
        std::transform(dem.height.begin(), dem.height.end(), dem.is_void.begin(),
                       [](float h) { return std::uint8_t{std::isnan(h)}; });
    }
    if (dem.voids == 0 || policy == VoidPolicy::leave) return;
    if (policy == VoidPolicy::refuse) {
        const double percent = 100.0 * double(dem.voids) / double(dem.height.size());
        throw InputError(dem.source,
                         fmt::format("{} posts ({:.2g} %) have no elevation", dem.voids, percent),
                         "let voids be filled");
    }
    fill_voids(dem.columns, dem.rows, dem.height);
}

void crop(Dem& dem, const PostWindow& window) {
    std::vector<float> kept;
    kept.reserve(std::size_t(window.columns) * window.rows);
    for (int row = 0; row < window.rows; ++row) {
        const auto from =
            dem.height.begin() + window.column + std::ptrdiff_t(row + window.row) * dem.columns;
        kept.insert(kept.end(), from, from + window.columns);
    }
    auto& t = dem.transform;
    t[0] += t[1] * window.column + t[2] * window.row;
    t[3] += t[4] * window.column + t[5] * window.row;
    dem.columns = window.columns;
    dem.rows = window.rows;
    dem.height = std::move(kept);
}

/// Where a tile's first post lies on the lattice of another.
std::array<int, 2> lattice_place(const Dem& tile, const Dem& first) {
    const auto &a = first.transform, &b = tile.transform;
    const double cell = std::sqrt(std::abs(a[1] * a[5] - a[2] * a[4]));
    bool same = same_reference(tile, first);
    for (const int k : {1, 2, 4, 5}) same = same && std::abs(a[k] - b[k]) < 1e-5 * cell;
    if (!same) {
        throw InputError(tile.source, fmt::format("has another grid than {}", first.source),
                         "bring tiles to one CRS and spacing, for example by gdalwarp");
    }
    double dx = b[0] - a[0];
    const double dy = b[3] - a[3], whole = a[1] * a[5] - a[2] * a[4];
    if (is_geographic(first)) dx -= 360.0 * std::round(dx / 360.0);
    const double column = (a[5] * dx - a[2] * dy) / whole, row = (a[1] * dy - a[4] * dx) / whole;
    if (!(std::abs(column) < 1e6 && std::abs(row) < 1e6) ||
        std::abs(column - std::round(column)) > 0.01 || std::abs(row - std::round(row)) > 0.01) {
        throw InputError(tile.source,
                         fmt::format("its posts lie between those of {}", first.source));
    }
    return {static_cast<int>(std::round(column)), static_cast<int>(std::round(row))};
}

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
    dem.transform = tiles.front().transform;
    auto& t = dem.transform;
    t[0] += t[1] * low[0] + t[2] * low[1];
    t[3] += t[4] * low[0] + t[5] * low[1];
    dem.columns = high[0] - low[0];
    dem.rows = high[1] - low[1];
    if (double(dem.columns) * dem.rows > most_posts) {
        throw InputError(dem.source, fmt::format("its tiles span {} x {} posts; at most {:.0f} "
                                                 "million are held",
                                                 dem.columns, dem.rows, most_posts / 1e6));
    }
    dem.height.assign(std::size_t(dem.columns) * dem.rows, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        Dem& tile = tiles[i];
        std::size_t differing = 0;
        float worst = 0.0f;
        for (int row = 0; row < tile.rows; ++row) {
            float* to = dem.height.data() + std::size_t(row + place[i][1] - low[1]) * dem.columns +
                        std::size_t(place[i][0] - low[0]);
            for (int column = 0; column < tile.columns; ++column) {
                const float h = tile.at(row, column);
                if (std::isnan(to[column])) {
                    to[column] = h;
                } else if (std::abs(h - to[column]) > 1.0f) {
                    ++differing;
                    worst = std::max(worst, std::abs(h - to[column]));
                }
            }
        }
        dem.notes.insert(dem.notes.end(), tile.notes.begin(), tile.notes.end());
        if (differing > 0) {
            dem.notes.push_back(
                fmt::format("{}: {} posts shared with other tiles differ, by up to "
                            "{:.1f} m; the first tile's are taken",
                            tile.source, differing, worst));
        }
        tile.height = {};
    }
    return dem;
}

/// EGM96 added at a lattice of posts about 1 km apart, bilinear between.
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
            dem.height[std::size_t(row) * dem.columns + column] += static_cast<float>(
                (1 - v) * ((1 - u) * a[0] + u * a[1]) + v * ((1 - u) * b[0] + u * b[1]));
        }
    }
}

Dem finished(Dem dem, const DemOptions& options) {
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
