#include "render/eye/eye_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "render/light/band_inverse.hpp"

namespace diurna {

namespace {

/// The greatest error of straight cells along the columns, in kelvins of the band.
double straight_error(const Band& band, const Eigen::MatrixXd& fine) {
    struct Bend {
        double bend, least;  // [W m-2 sr-1] of a column
    };
    std::vector<Bend> columns;
    double darkest = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < fine.cols(); ++j) {
        const double least = fine.col(j).minCoeff();
        if (!(least > 0.0)) continue;
        double bend = 0.0;
        for (Eigen::Index i = 1; i + 1 < fine.rows(); ++i) {
            bend =
                std::max(bend, std::abs(fine(i - 1, j) - 2.0 * fine(i, j) + fine(i + 1, j)) / 8.0);
        }
        columns.push_back({bend, least});
        darkest = std::min(darkest, least);
    }
    // A kelvin changes radiance least where it is darkest: so no column can be worse than its bend
    // there, and most need no temperature of their own.
    const auto per_kelvin = [&](double radiance) {
        return diurna::radiance_per_kelvin(band, radiance);
    };
    std::sort(columns.begin(), columns.end(),
              [](const Bend& a, const Bend& b) { return a.bend > b.bend; });
    double worst = 0.0;
    const double least_per_kelvin = columns.empty() ? 1.0 : per_kelvin(darkest);
    for (const auto& [bend, least] : columns) {
        if (bend / least_per_kelvin <= worst) break;
        worst = std::max(worst, bend / per_kelvin(least));
    }
    return worst;
}

/// Halves the cells of one direction until their error is below a tolerance; returns that error.
///
/// - values: (band)(surface) along the columns, at `coarse` nodes
/// - fine: nodes of the grid
double halve_cells(std::span<const BandLight> bands,
                   std::span<const std::vector<Eigen::MatrixXd>> values, std::size_t coarse,
                   double tolerance, std::size_t most, std::size_t& fine) {
    double error = 0.0;
    const Eigen::MatrixXd matrix = interpolation_matrix(coarse, fine);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        for (const Eigen::MatrixXd& value : values[b]) {
            error = std::max(error, straight_error(bands[b].band, matrix * value));
        }
    }
    // Second differences fall to a quarter with each halving.
    while (error > tolerance && 2 * fine - 1 <= most) {
        fine = 2 * fine - 1;
        error /= 4.0;
    }
    return error;
}

}  // namespace

EyeGrid eye_grid(const SightGrid& path, double ground_height_km, std::span<const BandLight> bands,
                 std::span<const std::vector<Eigen::MatrixXd>> surfaces, double tolerance) {
    constexpr std::size_t most_ranges = 1025, most_heights = 129;
    EyeGrid grid{.ranges = 4 * (path.ranges - 1) + 1, .heights = 4 * (path.heights - 1) + 1};
    std::vector<std::vector<Eigen::MatrixXd>> by_height(surfaces.begin(), surfaces.end());
    for (auto& of_band : by_height) {
        for (Eigen::MatrixXd& radiance : of_band) radiance.transposeInPlace();
    }
    grid.error = halve_cells(bands, surfaces, path.ranges, tolerance, most_ranges, grid.ranges) +
                 halve_cells(bands, by_height, path.heights, tolerance, most_heights, grid.heights);
    // The path's grid is uniform in the cube root of kilometres: a tenth of that of metres.
    const double finer = double(grid.ranges - 1) / double(path.ranges - 1);
    grid.per_root = static_cast<float>(0.1 * path.places_per_root() * finer);
    grid.root_low = static_cast<float>(10.0 * path.root_low);
    grid.per_height = static_cast<float>(1e-3 * path.places_per_height_km() *
                                         double(grid.heights - 1) / double(path.heights - 1));
    grid.height_low = static_cast<float>(1e3 * (path.extent.least_height_km - ground_height_km));
    return grid;
}

void find_places(const EyeGrid& grid, std::span<const float> range,
                 std::span<const float> range_root, std::span<const float> height,
                 GridPlaces& out) {
    const std::size_t count = range.size();
    assert(count <= GridPlaces::most);
    const auto last_range = static_cast<float>(grid.ranges - 2),
               last_height = static_cast<float>(grid.heights - 2);
    const auto stride = static_cast<std::int32_t>(grid.heights);
    const auto cell = [](float x, float last) {
        const float c = x < 0.0f ? 0.0f : x;
        return static_cast<std::int32_t>(c > last ? last : c);
    };
    for (std::size_t k = 0; k < count; ++k) {
        const float x = (range_root[k] - grid.root_low) * grid.per_root;
        const float y = (height[k] - grid.height_low) * grid.per_height;
        const std::int32_t i = cell(x, last_range), j = cell(y, last_height);
        out.start[k] = static_cast<std::uint32_t>(i * stride + j);
        out.range[k] = x - static_cast<float>(i);
        out.height[k] = y - static_cast<float>(j);
        out.per_metre[k] = grid.per_root * range_root[k] / (3.0f * range[k]);
    }
}

}  // namespace diurna
