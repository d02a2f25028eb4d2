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

/// Triangles over one lattice: what they are off its posts.
class PostCheck {
 public:
    /// - touching: how far beside a triangle a post may lie and count as under it [posts]
    PostCheck(const Dem& dem, double touching)
        : dem_(dem), touching_(touching), error_(dem.height.size(), -1.0f) {}

    /// Corners (column, row, height) that turn left seen from above.
    void add(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& k) {
        const Eigen::Vector2d a = i.head<2>(), b = j.head<2>(), c = k.head<2>();
        const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const double across = (c - b).norm(), down = (a - c).norm(), along = (b - a).norm();
        // Beside a sliver its plane reports nothing.
        const double width = turn(a, c, b) / std::max({across, down, along});
        const double beside = width > 10.0 * touching_ ? touching_ : std::min(touching_, 1e-9);
        const auto first = [&](double x) { return std::max(0, int(std::ceil(x - touching_))); };
        const int last_row = std::min(dem_.rows - 1, int(std::floor(high.y() + touching_)));
        const int last_column = std::min(dem_.columns - 1, int(std::floor(high.x() + touching_)));
        for (int row = first(low.y()); row <= last_row; ++row) {
            for (int column = first(low.x()); column <= last_column; ++column) {
                const Eigen::Vector2d post(column, row);
                double wa = turn(post, c, b), wb = turn(a, c, post), wc = turn(a, post, b);
                if (wa < -beside * across || wb < -beside * down || wc < -beside * along) continue;
                // The triangle's own heights, where the post lies just beside it.
                for (double* w : {&wa, &wb, &wc}) *w = std::max(*w, 0.0);
                const double surface = (wa * i.z() + wb * j.z() + wc * k.z()) / (wa + wb + wc);
                const double off = std::abs(surface - dem_.at(row, column));
                float& worst = error_[std::size_t(row) * dem_.columns + column];
                worst = std::max(worst, std::isnan(off) ? 1e30f : static_cast<float>(off));
                worst_ = std::max(worst_, std::isnan(off) ? 1e30 : off);
            }
        }
    }

    /// Adds what was found to a check whose mean is still a sum of squares, over so many posts.
    ///
    /// - counts: of (column, row), whether triangles should lie on it
    template <class Counts>
    void tell(TinCheck& result, std::size_t& covered, const Counts& counts) const {
        const auto coverable = coverable_posts(dem_);
        for (std::size_t post = 0; post < error_.size(); ++post) {
            if (error_[post] >= 0.0f) {
                result.rms_error += double{error_[post]} * error_[post];
                ++covered;
            } else if (coverable[post] && counts(Eigen::Vector2d(double(post % dem_.columns),
                                                                 double(post / dem_.columns)))) {
                ++result.uncovered_posts;
            }
        }
        result.worst_error = std::max(result.worst_error, worst_);
    }
    double worst() const { return worst_; }

 private:
    const Dem& dem_;
    double touching_;
    std::vector<float> error_;  // (post) negative where no triangle lies
    double worst_ = 0.0;
};

/// - on_detail: (triangle) the detail that it lies on, −1: none; empty: none does
TinCheck check(const Dem& dem, std::span<const Eigen::Vector2d> place,
               std::span<const float> height,
               std::span<const std::array<std::uint32_t, 3>> triangles,
               std::span<const std::int32_t> on_detail) {
    TinCheck result;
    // A straight side of the coarse lattice is slightly bent on a detail's.
    constexpr double rounding = 1e-9, bent = 2e-3;
    PostCheck coarse(dem, rounding);
    std::vector<PostCheck> fine;
    for (const DemDetail& detail : dem.detail) fine.emplace_back(detail.raster, bent);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [i, j, k] = triangles[t];
        // Rows run south: what turns left seen from above turns right in (column, row).
        const double area = turn(place[i], place[k], place[j]);
        if (!(area > 0.0)) {
            ++result.flipped_triangles;
            continue;
        }
        const std::int32_t under = on_detail.empty() ? -1 : on_detail[t];
        const auto corner = [&](std::uint32_t v) {
            const Eigen::Vector2d own =
                under < 0 ? place[v] : dem.detail[std::size_t(under)].to_own(place[v]);
            return Eigen::Vector3d(own.x(), own.y(), height[v]);
        };
        if (area < 1e-9) continue;  // thinner than rounding: its border is its neighbours' too
        (under < 0 ? coarse : fine[std::size_t(under)]).add(corner(i), corner(j), corner(k));
    }
    std::size_t covered = 0;
    coarse.tell(result, covered, [&](const auto& post) { return detail_at(dem, post) < 0; });
    for (std::size_t k = 0; k < fine.size(); ++k) {
        fine[k].tell(result, covered, [&](const auto& post) {
            return detail_at(dem, dem.detail[k].to_coarse(post)) == int(k);
        });
        result.worst_on_detail = std::max(result.worst_on_detail, fine[k].worst());
    }
    result.rms_error =
        covered > 0 ? std::sqrt(result.rms_error / static_cast<double>(covered)) : 0.0;
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
    return check(dem, place, height, tin.triangle, {});
}

TinCheck check_ground_mesh(const Dem& dem, const GroundMesh& mesh) {
    return check(dem, mesh.place, mesh.height, mesh.triangle, mesh.detail);
}

}  // namespace diurna
