#include "terrain/ground/tin_check.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/ground/rings.hpp"

namespace diurna {

namespace {

/// Posts that a surface can reach: corners of a cell of which at least three corners are valid.
std::vector<std::uint8_t> coverable_posts(const Dem& dem) {
    std::vector<std::uint8_t> coverable(dem.height.size(), 0);
    for (int row = 0; row + 1 < dem.rows; ++row) {
        for (int column = 0; column + 1 < dem.columns; ++column) {
            const std::size_t corner = std::size_t(row) * dem.columns + column;
            const std::size_t cell[] = {corner, corner + 1, corner + dem.columns,
                                        corner + dem.columns + 1};
            const auto valid = [&](std::size_t post) { return !std::isnan(dem.height[post]); };
            if (std::count_if(std::begin(cell), std::end(cell), valid) < 3) continue;
            for (const std::size_t post : cell) {
                if (valid(post)) coverable[post] = 1;
            }
        }
    }
    return coverable;
}

TinCheck check(const Dem& dem, std::span<const Eigen::Vector2d> place,
               std::span<const float> height,
               std::span<const std::array<std::uint32_t, 3>> triangles) {
    TinCheck result;
    std::vector<float> error(dem.height.size(), -1.0f);
    for (const auto& [i, j, k] : triangles) {
        const Eigen::Vector2d &a = place[i], &b = place[j], &c = place[k];
        // Rows run south: what turns left seen from above turns right in (column, row).
        const double area = turn(a, c, b);
        if (!(area > 0.0)) {
            ++result.flipped_triangles;
            continue;
        }
        if (area < 1e-9) continue;  // thinner than rounding: its border is its neighbours' too
        const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        for (int row = static_cast<int>(std::ceil(low.y())); row <= high.y(); ++row) {
            for (int column = static_cast<int>(std::ceil(low.x())); column <= high.x(); ++column) {
                const Eigen::Vector2d post(column, row);
                const double wa = turn(post, c, b), wb = turn(a, c, post), wc = turn(a, post, b);
                if (std::min({wa, wb, wc}) < -1e-9) continue;
                const double surface =
                    (wa * height[i] + wb * height[j] + wc * height[k]) / (wa + wb + wc);
                const double off = std::abs(surface - dem.at(row, column));
                float& worst = error[std::size_t(row) * dem.columns + column];
                worst = std::max(worst, std::isnan(off) ? 1e30f : static_cast<float>(off));
                result.worst_error = std::max(result.worst_error, std::isnan(off) ? 1e30 : off);
            }
        }
    }
    const auto coverable = coverable_posts(dem);
    double sum = 0.0;
    std::size_t covered = 0;
    for (std::size_t post = 0; post < error.size(); ++post) {
        if (error[post] >= 0.0f) {
            sum += double{error[post]} * error[post];
            ++covered;
        } else if (coverable[post]) {
            ++result.uncovered_posts;
        }
    }
    result.rms_error = covered > 0 ? std::sqrt(sum / static_cast<double>(covered)) : 0.0;
    return result;
}

}  // namespace

TinCheck check_tin(const Dem& dem, const Tin& tin) {
    std::vector<Eigen::Vector2d> place;
    std::vector<float> height;
    place.reserve(tin.post.size());
    height.reserve(tin.post.size());
    for (const auto& [column, row] : tin.post) {
        place.emplace_back(column, row);
        height.push_back(dem.at(row, column));
    }
    return check(dem, place, height, tin.triangle);
}

TinCheck check_ground_mesh(const Dem& dem, const GroundMesh& mesh) {
    return check(dem, mesh.place, mesh.height, mesh.triangle);
}

}  // namespace diurna
