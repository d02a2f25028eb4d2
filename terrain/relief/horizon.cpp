#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/relief/height_field.hpp"

namespace diurna {

namespace {

constexpr int tile_side = 64;  // posts that share one way

/// The crossings of a way with the grid's lines and diagonals, in order.
struct Way {
    std::vector<Crossing> crossing;
    std::vector<Stretch> stretch;

    MarchWay view() const {
        return {crossing.data(), stretch.data(), static_cast<int>(stretch.size())};
    }
};

/// `towards`: columns and rows per metre of plan. Starts at a post and goes on for `reach` metres.
Way way(const HeightField& field, const Eigen::Vector2d& towards, double reach) {
    struct Found {
        double distance;  // [m]
        int column, row, next_column, next_row;
        double weight;
    };
    const double u = towards.x(), v = towards.y();
    const double per_step = 1.0 / std::max(std::abs(u), std::abs(v));  // [m] per grid line
    std::vector<Found> found;
    const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
    const auto lines = [&](double speed, const auto& add) {
        if (std::abs(speed) * reach < 1.0) return;
        for (int k = 1;; ++k) {
            const double distance = k / std::abs(speed);
            if (distance > reach) return;
            add(distance, speed > 0.0 ? k : -k);
        }
    };
    lines(v, [&](double distance, int row) {
        const double x = u * distance;
        found.push_back({distance, whole(x), row, whole(x) + 1, row, x - std::floor(x)});
    });
    const std::size_t rows = found.size();
    lines(u, [&](double distance, int column) {
        const double y = v * distance;
        found.push_back({distance, column, whole(y), column, whole(y) + 1, y - std::floor(y)});
    });
    const std::size_t columns = found.size();
    lines(u - v, [&](double distance, int diagonal) {
        const double y = v * distance;
        const int row = whole(y), column = row + diagonal;
        found.push_back({distance, column, row, column + 1, row + 1, y - row});
    });
    // Each family of lines is in order already.
    const auto nearer = [](const Found& a, const Found& b) { return a.distance < b.distance; };
    const auto at = [&](std::size_t k) { return found.begin() + static_cast<std::ptrdiff_t>(k); };
    std::inplace_merge(found.begin(), at(rows), at(columns), nearer);
    std::inplace_merge(found.begin(), at(columns), found.end(), nearer);

    Way result;
    result.crossing.reserve(found.size());
    const auto pitch = static_cast<int>(field.pitch());
    std::size_t i = 0;
    for (int k = 0; i < found.size(); ++k) {
        const double near = k * march_steps * per_step, far = near + march_steps * per_step;
        Stretch stretch{.begin = static_cast<std::int32_t>(i),
                        .end = 0,
                        .column = 1 << 30,
                        .row = 1 << 30,
                        .inverse_near = k == 0 ? 1e30f : static_cast<float>(1.0 / near)};
        for (; i < found.size() && found[i].distance <= far * (1.0 + 1e-12); ++i) {
            const Found& f = found[i];
            result.crossing.push_back({f.row * pitch + f.column, f.next_row * pitch + f.next_column,
                                       static_cast<float>(f.weight),
                                       static_cast<float>(1.0 / f.distance)});
            stretch.column = std::min(stretch.column, f.column);
            stretch.row = std::min(stretch.row, f.row);
        }
        stretch.end = static_cast<std::int32_t>(i);
        result.stretch.push_back(stretch);
    }
    return result;
}

/// The ways of one azimuth: one for all posts where the plan is even; else one for each tile, found
/// when it is needed, since all of them at once would be gigabytes on a large raster.
class Ways {
 public:
    Ways(const HeightField& field, const Eigen::Vector2d& east_north)
        : field_(field), east_north_(east_north.normalized()) {
        const double right = field.columns() - 1, bottom = field.rows() - 1;
        const Eigen::Vector2d first = towards(0.0, 0.0);
        const double bent =
            std::max({(towards(right, 0.0) - first).norm(), (towards(0.0, bottom) - first).norm(),
                      (towards(right, bottom) - first).norm()});
        if (bent >= 1e-6 * first.norm()) return;
        even_ = way(field, first,
                    (std::max(right, bottom) + march_steps) / first.lpNorm<Eigen::Infinity>());
    }

    /// Of the tile that begins at a post; `room` holds it if it is not for all.
    const Way& at(int row, int column, Way& room) const {
        if (even_) return *even_;
        const double right = field_.columns() - 1, bottom = field_.rows() - 1;
        const Eigen::Vector2d to = towards(std::min(right, column + 0.5 * tile_side),
                                           std::min(bottom, row + 0.5 * tile_side));
        // To where the last of its posts leaves the grid, and a stretch more.
        const auto leaves = [](double speed, double first, double last) {
            if (speed == 0.0) return std::numeric_limits<double>::infinity();
            return speed > 0.0 ? (last - first) / speed : (first + tile_side) / -speed;
        };
        const double inside = std::min(leaves(to.x(), column, right), leaves(to.y(), row, bottom));
        room = way(field_, to, inside + 2.0 * march_steps / to.lpNorm<Eigen::Infinity>());
        return room;
    }

 private:
    Eigen::Vector2d towards(double column, double row) const {
        return field_.jacobian({column, row}).inverse() * east_north_;
    }

    const HeightField& field_;
    Eigen::Vector2d east_north_;
    std::optional<Way> even_;
};

MarchFunction* const march_posts =
    __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")
        ? march_avx512
        : march_avx2;

/// What is asked of each post's horizon.
struct Asked {
    double lift = 0.0;
    float start = 0.0f, stop = 1e30f;
};

/// One row of tiles; `tangent` of its posts alone.
void march_tiles(const HeightField& field, const Ways& ways, int tile_row, const Asked& asked,
                 std::span<float> tangent) {
    const MarchField heights = field.march_field();
    const int first_row = tile_row * tile_side;
    const int last_row = std::min(field.rows(), first_row + tile_side);
    Way room;
    for (int column = 0; column < field.columns(); column += tile_side) {
        const MarchPart part{.first_row = first_row,
                             .last_row = last_row,
                             .first_column = column,
                             .last_column = std::min(field.columns(), column + tile_side),
                             .lift = static_cast<float>(asked.lift),
                             .start = asked.start,
                             .stop = asked.stop};
        march_posts(heights, ways.at(first_row, column, room).view(), part, tangent.data() + column,
                    field.columns());
    }
}

std::size_t tile_rows_of(const HeightField& field) {
    return static_cast<std::size_t>((field.rows() + tile_side - 1) / tile_side);
}

/// Calls body(row of tiles, its first post, its posts), in parallel.
template <class Body>
void for_each_tile_row(const HeightField& field, const Body& body) {
    const auto row_posts = std::size_t(field.columns()) * tile_side;
    for_each_index(
        tile_rows_of(field),
        [&](std::size_t row) {
            const std::size_t first = row * row_posts;
            body(static_cast<int>(row), first, std::min(row_posts, field.size() - first));
        },
        1);
}

void march(const HeightField& field, const Eigen::Vector2d& east_north, const Asked& asked,
           std::span<float> tangent) {
    assert(tangent.size() == field.size());
    const Ways found(field, east_north);
    for_each_tile_row(field, [&](int row, std::size_t first, std::size_t posts) {
        march_tiles(field, found, row, asked, tangent.subspan(first, posts));
    });
}

/// π/2 − atan t for t ≥ 0, within 1e-6 rad (odd polynomial on [0, 1], Abramowitz & Stegun 4.4.49).
inline float arc_cotangent(float t) {
    const bool steep = t > 1.0f;
    const float x = steep ? 1.0f / t : t;
    const float s = x * x;
    const float arc =
        x * (1.0f + s * (-0.3333314528f +
                         s * (0.1999355085f +
                              s * (-0.1420889944f +
                                   s * (0.1065626393f +
                                        s * (-0.0752896400f +
                                             s * (0.0429096138f +
                                                  s * (-0.0161657367f + s * 0.0028662257f))))))));
    constexpr float quarter = std::numbers::pi_v<float> / 2.0f;
    return steep ? arc : quarter - arc;
}

}  // namespace

void horizon(const HeightField& field, double azimuth_deg, std::span<float> tangent, double lift) {
    march(field, direction(azimuth_deg, 0.0).head<2>(), {.lift = lift}, tangent);
}

void horizon_near(const HeightField& field, const Eigen::Vector3d& direction, double margin,
                  std::span<float> tangent, double lift) {
    const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    const auto tan_at = [](double angle) {
        return static_cast<float>(std::tan(std::clamp(angle, 0.0, 1.55)));
    };
    const Eigen::Vector2d plan = direction.head<2>();
    march(field, plan.norm() > 1e-9 ? plan : Eigen::Vector2d(0.0, 1.0),
          {.lift = lift, .start = tan_at(elevation - margin), .stop = tan_at(elevation + margin)},
          tangent);
}

float disc_above(float horizon_tangent, double sun_elevation) {
    const double radius = sun_angular_radius;
    const double x = (sun_elevation - std::atan(double{horizon_tangent})) / radius;
    if (x >= 1.0) return 1.0f;
    if (x <= -1.0) return 0.0f;
    return static_cast<float>(1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / std::numbers::pi);
}

void sun_fraction(const HeightField& field, const Eigen::Vector3d& direction,
                  std::span<float> fraction, double lift) {
    assert(fraction.size() == field.size());
    const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    const double radius = sun_angular_radius;
    horizon_near(field, direction, radius, fraction, lift);
    const auto lower = static_cast<float>(std::tan(std::max(0.0, elevation - radius)));
    const auto upper = static_cast<float>(std::tan(std::max(0.0, elevation + radius)));
    for_each_tile_row(field, [&](int, std::size_t first, std::size_t posts) {
        for (float& x : fraction.subspan(first, posts)) {
            if (x >= upper) {
                x = 0.0f;
            } else if (x <= lower && elevation > radius) {
                x = 1.0f;
            } else {
                x = disc_above(x, elevation);
            }
        }
    });
}

void sky_view(const HeightField& field, int azimuths, std::span<float> sky_view) {
    assert(sky_view.size() == field.size() && azimuths > 0);
    struct Look {
        Eigen::Vector2f towards;
        Ways ways;
    };
    std::vector<Look> looks;
    for (int k = 0; k < azimuths; ++k) {
        const Eigen::Vector2d towards = direction(360.0 * (k + 0.5) / azimuths, 0.0).head<2>();
        looks.push_back({towards.cast<float>(), Ways(field, towards)});
    }
    const int columns = field.columns();
    for_each_tile_row(field, [&](int tile_row, std::size_t first, std::size_t posts) {
        std::vector<float> tangent(posts), east(posts), north(posts), up(posts), sum(posts);
        for (std::size_t i = 0; i < posts; ++i) {
            const Eigen::Vector3f n = field.normal(static_cast<int>((first + i) / columns),
                                                   static_cast<int>((first + i) % columns));
            east[i] = n.x();
            north[i] = n.y();
            up[i] = n.z();
        }
        for (const Look& look : looks) {
            march_tiles(field, look.ways, tile_row, {}, tangent);
            const float x = look.towards.x(), y = look.towards.y();
#pragma omp simd
            for (std::size_t i = 0; i < posts; ++i) {
                const float along = x * east[i] + y * north[i];
                const float own = -along / up[i];
                const float t = tangent[i] > own ? tangent[i] : own;
                const float cos2 = 1.0f / (1.0f + t * t);
                sum[i] += up[i] * cos2 + along * (arc_cotangent(t) - t * cos2);
            }
        }
        for (std::size_t i = 0; i < posts; ++i) {
            sky_view[first + i] = std::min(1.0f, sum[i] / static_cast<float>(azimuths));
        }
    });
}

}  // namespace diurna
