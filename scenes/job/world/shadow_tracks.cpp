#include "scenes/job/world/shadow_tracks.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "scenes/job/world/ground_point.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double least_sine = 0.2;       // of the sun's elevation
constexpr double edges_a_breadth = 5.0;  // of an object
constexpr double widest_penumbra = 3.0;  // breadths
constexpr int edges_a_tile = 4;
constexpr double most_triangles = 1e4;  // about, of one object; of copies a tenth more each
using TrackTile = std::pair<int, int>;  // row, column

constexpr std::size_t many_copies = 30;  // copies: each over level ground of its own

/// Shadows of the lowest and the highest point.
using Ends = std::array<Eigen::Vector2d, 2>;

/// What hovers at one place.
struct Hovering {
    Eigen::Vector3d base;
    double ground = 0.0;                      // up [m] below it
    std::vector<std::optional<Ends>> ends{};  // (day, hour) of its shadow; none: too faint, no sun
};

/// Where a point's shadow falls on the ground: some steps from the level ground below it.
Eigen::Vector2d landing(const Hovering& of, double above, const Eigen::Vector3d& sun, int steps,
                        const Dem& dem, const Site& site) {
    const Eigen::Vector2d under = of.base.head<2>(), along = -sun.head<2>() / sun.z();
    const double top = of.base.z() + above, level = top - of.ground;
    double drop = level;
    for (int k = 0; k < steps; ++k) {
        const auto ground = ground_if_any(dem, site, under + drop * along);
        if (!ground) break;
        drop = std::clamp(top - ground->z(), 0.0, 3.0 * level);
    }
    return under + drop * along;
}

/// Sets where its shadow falls.
void find_ends(Hovering& of, const ObjectInput& object, const SunCourses& sun, int steps,
               const Dem& dem, const Site& site) {
    const double furthest =
        widest_penumbra * object_breadth(object) / (2.0 * sun_angular_radius);  // [m]
    const double height = object_height(object);
    for (std::size_t d = 0; d < sun.days(); ++d) {
        for (std::size_t h = 0; h < sun.hours(); ++h) {
            const Eigen::Vector3d& to = sun.at(d, h);
            of.ends.emplace_back();
            if (to.z() <= 0.0 || (of.base.z() - of.ground) / to.z() > furthest) continue;
            of.ends.back() = {landing(of, 0.0, to, steps, dem, site),
                              landing(of, height, to, steps, dem, site)};
        }
    }
}

/// The tiles of one object's shadows.
class Tracks {
 public:
    Tracks(const ObjectInput& object, double near_edge, double edge)
        : half_(shadow_reach(object) - 2.0 * object_height(object)),
          near_(near_edge <= edge ? shadow_reach(object) : 0.0),
          edge_(edge) {}

    void add(const Hovering& of, const SunCourses& sun) {
        for (std::size_t d = 1; d < sun.days(); ++d) {
            const auto* const before = of.ends.data() + (d - 1) * sun.hours();
            const auto* const now = before + sun.hours();
            for (std::size_t h = 0; h + 1 < sun.hours(); ++h) {
                if (before[h] && before[h + 1] && now[h] && now[h + 1]) {
                    fill({*before[h], *before[h + 1], *now[h], *now[h + 1]});
                }
            }
        }
        if (near_ > 0.0) squares_.emplace_back(of.base.head<2>());
    }

    double count() const { return 2.3 * edges_a_tile * edges_a_tile * double(tile_.size()); }

    /// Each row's tiles that lie side by side as one ring.
    std::vector<GroundPatch> patches() const {
        std::vector<GroundPatch> all;
        for (auto tile = tile_.begin(); tile != tile_.end();) {
            const int row = tile->first, west = tile->second;
            int east = west;
            for (; tile != tile_.end() && *tile == TrackTile{row, east}; ++tile) {
                if (below(*tile)) break;
                ++east;
            }
            if (east > west) all.push_back(ring_of(row, west, east));
            if (tile != tile_.end() && *tile == TrackTile{row, east}) ++tile;
        }
        return all;
    }

 private:
    // So that rounding does not make the sides longer than requested.
    double lattice() const { return 0.999 * edge_; }
    double side() const { return lattice() * edges_a_tile; }

    void mark(const Eigen::Vector2d& middle) {
        const double reach = half_ + edge_;
        const Eigen::Vector2i low = ((middle.array() - reach) / side()).floor().cast<int>();
        const Eigen::Vector2i high = ((middle.array() + reach) / side()).floor().cast<int>();
        for (int row = low.y(); row <= high.y(); ++row) {
            for (int column = low.x(); column <= high.x(); ++column) tile_.emplace(row, column);
        }
    }
    /// All between four directions of the sun: two hours of a day, the same of a later one.
    void fill(const std::array<Ends, 4>& corner) {
        const auto parts = [&](double length) {
            return std::max(1, int(std::ceil(length / std::max(side(), half_))));
        };
        const auto apart = [&](std::size_t a, std::size_t b) {
            return std::max((corner[a][0] - corner[b][0]).norm(),
                            (corner[a][1] - corner[b][1]).norm());
        };
        double upright = 0.0;
        for (const Ends& of : corner) upright = std::max(upright, (of[1] - of[0]).norm());
        const int hours = parts(std::max(apart(0, 1), apart(2, 3)));
        const int days = parts(std::max(apart(0, 2), apart(1, 3))), ends = parts(upright);
        const auto between = [](const Ends& a, const Ends& b, double share) {
            return Ends{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
        };
        for (int h = 0; h <= hours; ++h) {
            const double hour = double(h) / hours;
            const Ends first = between(corner[0], corner[1], hour);
            const Ends last = between(corner[2], corner[3], hour);
            for (int d = 0; d <= days; ++d) {
                const Ends here = between(first, last, double(d) / days);
                for (int e = 0; e <= ends; ++e) {
                    mark(here[0] + double(e) / ends * (here[1] - here[0]));
                }
            }
        }
    }
    /// Within a square of fine ground below an object.
    bool below(const TrackTile& tile) const {
        const Eigen::Vector2d low(side() * tile.second, side() * tile.first);
        return std::any_of(squares_.begin(), squares_.end(), [&](const Eigen::Vector2d& middle) {
            return (low - middle).minCoeff() >= -near_ &&
                   (low - middle).maxCoeff() + side() <= near_;
        });
    }
    GroundPatch ring_of(int row, int west, int east) const {
        GroundPatch patch{.ring = {}, .largest_edge = edge_};
        const int low = row * edges_a_tile, high = low + edges_a_tile;
        const int from = west * edges_a_tile, to = east * edges_a_tile;
        const auto add = [&](int x, int y) {
            patch.ring.emplace_back(lattice() * x, lattice() * y);
        };
        for (int x = from; x < to; ++x) add(x, low);
        for (int y = low; y < high; ++y) add(to, y);
        for (int x = to; x > from; --x) add(x, high);
        for (int y = high; y > low; --y) add(from, y);
        return patch;
    }

    double half_;  // [m] of its plan's diagonal
    double near_;  // [m] half of the squares below; 0: none counts
    double edge_;  // [m]
    std::set<TrackTile> tile_{};
    std::vector<Eigen::Vector2d> squares_{};  // middles
};

}  // namespace

SunCourses::SunCourses(const Site& site, const TimeInput& time) {
    using namespace std::chrono;
    const auto month_of = [](Instant when) {
        const year_month_day date(floor<std::chrono::days>(when));
        return date.year() / date.month();
    };
    const year_month last = std::min(month_of(time.end()), month_of(time.start) + months(11));
    const sys_days first_day = month_of(time.start) / 1;
    const sys_days last_day = last / std::chrono::last;
    const double length = double((last_day - first_day).count());
    days_ = std::size_t(std::ceil(length / 10.0)) + 1;
    constexpr double apart = 1200.0;  // [s]
    hours_ = std::size_t(86400.0 / apart) + 1;
    for (std::size_t d = 0; d < days_; ++d) {
        const double days = std::round(length * double(d) / double(days_ - 1));
        for (std::size_t h = 0; h < hours_; ++h) {
            const Instant when = later(Instant(first_day), 86400.0 * days + apart * double(h));
            const Eigen::Vector3d to = sun_direction(sun_position(site, when));
            direction_.push_back(to.z() > least_sine ? to : Eigen::Vector3d::Zero());
        }
    }
}

std::vector<GroundPatch> shadow_tracks(const ObjectInput& object,
                                       std::span<const Eigen::Vector3d> base, const SunCourses& sun,
                                       const Dem& dem, const Site& site) {
    std::vector<Hovering> all;
    double highest = 0.0;
    for (const Eigen::Vector3d& at : base) {
        const auto ground = ground_if_any(dem, site, at.head<2>());
        if (!ground) continue;
        const double near_edge = ground_patch(object, at.head<2>()).largest_edge;
        if (at.z() - ground->z() <= near_edge) continue;
        all.push_back({.base = at, .ground = ground->z()});
        highest = std::max(highest, at.z() - ground->z());
    }
    if (all.empty()) return {};
    for (Hovering& of : all)
        find_ends(of, object, sun, all.size() > many_copies ? 0 : 3, dem, site);
    const double near_edge = ground_patch(object, {0.0, 0.0}).largest_edge;
    double edge = std::max(
        {near_edge, object_breadth(object) / edges_a_breadth, sun_angular_radius * highest});
    const double most = most_triangles * (1.0 + 0.1 * double(all.size() - 1));
    for (int k = 0;; ++k) {
        Tracks tracks(object, near_edge, edge);
        for (const Hovering& of : all) tracks.add(of, sun);
        if (tracks.count() <= most || k == 4) return tracks.patches();
        edge *= 1.05 * std::sqrt(tracks.count() / most);
    }
}

}  // namespace diurna
