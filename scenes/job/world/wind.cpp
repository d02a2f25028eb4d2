#include "scenes/job/world/wind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

#include "materials/base/parallel.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/object_parts.hpp"
#include "thermal/weather/wind_share.hpp"

namespace diurna {

namespace {

constexpr std::size_t directions = 16;

/// The raster's height at a place; `otherwise` outside it and over voids.
double ground_at(const World& world, const Eigen::Vector2d& place, double otherwise) {
    const HeightField& field = *world.relief;
    const Eigen::Vector2d post = field.post(place);
    const double column = std::floor(post.x()), row = std::floor(post.y());
    if (!(column >= 0.0 && row >= 0.0 && column + 1.0 < field.columns() &&
          row + 1.0 < field.rows())) {
        return otherwise;
    }
    const int c = int(column), r = int(row);
    const double x = post.x() - column, y = post.y() - row;
    const auto up = [&](int down, int right) { return double(field.up(r + down, c + right)); };
    const double height =
        std::lerp(std::lerp(up(0, 0), up(0, 1), x), std::lerp(up(1, 0), up(1, 1), x), y);
    return height > -1e4 ? height : otherwise;
}

/// A body that stands in the wind.
struct Obstacle {
    BodyBox box;
    std::uint32_t body;
    double ground, height, reach;  // [m]; reach from its middle
};

constexpr std::uint32_t nobody = 0xFFFFFFFFu;

void add_obstacle(const World& world, const BodyBox& box, std::uint32_t body,
                  std::vector<Obstacle>& found) {
    const double ground = ground_at(world, box.middle, box.bottom);
    const double height = box.top - ground;
    // What hangs in the air is no wall.
    if (height <= 0.0 || box.bottom - ground > 0.5 * height) return;
    found.push_back({box, body, ground, height,
                     lee_reach * height + std::hypot(box.half_length, box.half_width)});
}

std::vector<Obstacle> obstacles(const World& world, const ObjectBodies& parts) {
    std::vector<Obstacle> found;
    for (std::uint32_t b = 0; b < parts.body.size(); ++b) {
        add_obstacle(world, parts.body[b], b, found);
    }
    return found;
}

/// A box for each copy, a body that no facet is of.
void add_copies(const World& world, std::vector<Obstacle>& found) {
    std::map<std::uint32_t, BodyBox> own;  // by the first facet of what is copied
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        if (own.count(copy.first) == 0) {
            own.emplace(copy.first, box_round(world.facets, copy.first, copy.facets));
        }
        add_obstacle(world, placed_box(own.at(copy.first), copy.pose), nobody, found);
    }
}

/// How far upwind of a place a box stands in the way; negative where it does not.
///
/// towards  where the wind comes from, unit
double upwind_distance(const BodyBox& box, const Eigen::Vector2d& place,
                       const Eigen::Vector2d& towards) {
    const Eigen::Vector2d from = place - box.middle;
    const Eigen::Vector2d side(-box.along.y(), box.along.x());
    double enter = 0.0, leave = 1e9;
    for (const auto& [axis, half] :
         {std::pair{box.along, box.half_length}, {side, box.half_width}}) {
        const double at = from.dot(axis), speed = towards.dot(axis);
        if (std::abs(speed) < 1e-12) {
            if (std::abs(at) > half) return -1.0;
            continue;
        }
        const double one = (-half - at) / speed, other = (half - at) / speed;
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    return leave > enter ? enter : -1.0;
}

/// Obstacles by the cells of a grid that they reach.
class Reached {
 public:
    Reached(const std::vector<Obstacle>& all, const FacetSet& facets) : all_(all) {
        for (std::size_t d = 0; d < directions; ++d) {
            const double angle = 2.0 * std::numbers::pi * (double(d) + 0.5) / directions;
            compass_[d] = {std::cos(angle), std::sin(angle)};
        }
        for (const Eigen::Vector3f& v : facets.vertex) {
            low_ = low_.cwiseMin(v.head<2>().cast<double>());
            high_ = high_.cwiseMax(v.head<2>().cast<double>());
        }
        for (std::uint32_t o = 0; o < all.size(); ++o) {
            const Eigen::Vector2d far = Eigen::Vector2d::Constant(all[o].reach);
            const Eigen::Vector2i from = cell(all[o].box.middle - far);
            const Eigen::Vector2i to = cell(all[o].box.middle + far);
            for (int y = from.y(); y <= to.y(); ++y) {
                for (int x = from.x(); x <= to.x(); ++x) in_[place(x, y)].push_back(o);
            }
        }
    }

    /// What is left of the wind at a place in the lee of all bodies that it is `no_part_of`.
    template <class Foreign>
    float share(const Eigen::Vector3d& at, const Foreign& no_part_of) const {
        const Eigen::Vector2i here = cell(at.head<2>());
        std::array<double, directions> deficit{};
        bool any = false;
        for (const std::uint32_t o : in_[place(here.x(), here.y())]) {
            const Obstacle& obstacle = all_[o];
            const Eigen::Vector2d to = obstacle.box.middle - at.head<2>();
            const double far = to.squaredNorm();
            if (far > obstacle.reach * obstacle.reach || !no_part_of(obstacle)) continue;
            const double round = std::hypot(obstacle.box.half_length, obstacle.box.half_width);
            for (std::size_t d = 0; d < directions; ++d) {
                const Eigen::Vector2d& towards = compass_[d];
                const double aside = to.x() * towards.y() - to.y() * towards.x();
                if (aside * aside > round * round) continue;
                const double distance = upwind_distance(obstacle.box, at.head<2>(), towards);
                if (distance < 0.0) continue;
                const double less =
                    lee_deficit(distance, obstacle.height, at.z() - obstacle.ground);
                deficit[d] = std::max(deficit[d], less);
                any = any || less > 0.0;
            }
        }
        if (!any) return 1.0f;
        double share = 1.0;
        for (const double less : deficit) share -= less / double(directions);
        return float(share);
    }

 private:
    static constexpr int cells = 64;  // each way
    static std::size_t place(int x, int y) { return std::size_t(y) * cells + std::size_t(x); }
    Eigen::Vector2i cell(const Eigen::Vector2d& at) const {
        const Eigen::Vector2d size = (high_ - low_).cwiseMax(1e-3) / double(cells);
        const Eigen::Vector2d in = (at - low_).cwiseQuotient(size);
        return in.array().floor().max(0.0).min(cells - 1.0).matrix().cast<int>();
    }

    const std::vector<Obstacle>& all_;
    std::array<Eigen::Vector2d, directions> compass_;
    Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e9), high_ = Eigen::Vector2d::Constant(-1e9);
    std::array<std::vector<std::uint32_t>, std::size_t(cells) * cells> in_;
};

}  // namespace

std::vector<FilmPart> parts_in_wind(const World& world, const MaterialLibrary& materials,
                                    double wind_height) {
    const FacetSet& solid = world.facets;
    if (world.ground_facets >= solid.size()) return {};
    const ObjectBodies parts = object_parts(solid, world.ground_facets);
    std::vector<Obstacle> standing = obstacles(world, parts);
    add_copies(world, standing);
    const Reached reached(standing, solid);
    std::vector<FilmPart> of_solid(solid.size());
    for_each_index(solid.size(), [&](std::size_t f) {
        FilmPart& part = of_solid[f];
        const Eigen::Vector3d at = solid.centroid[f].cast<double>();
        if (f < world.ground_facets) {
            part.wind = reached.share(at, [](const Obstacle&) { return true; });
            return;
        }
        const PartSize& size = parts.size[f - world.ground_facets];
        part = {
            .rise = size.rise, .breadth = size.breadth, .chord = size.chord, .across = size.across};
        const ThermalSurface& surface = materials[solid.material[f]].thermal;
        if (surface.flight) return;
        part.wind =
            reached.share(at, [&](const Obstacle& other) { return other.body != size.body; });
        if (std::holds_alternative<Louis>(surface.convection)) return;  // has its own profile
        const double ground = ground_at(world, at.head<2>(), parts.body[size.body].bottom);
        part.wind *= float(wind_at_height(at.z() - ground, wind_height));
    });
    return on_surfaces(world.texture_levels, std::move(of_solid));
}

BodyBox box_round(const FacetSet& facets, std::size_t first, std::size_t count) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    double area = 0.0;
    for (std::size_t f = first; f < first + count; ++f) {
        const Eigen::Vector2d at = facets.centroid[f].head<2>().cast<double>();
        area += facets.area[f];
        mean += facets.area[f] * at;
    }
    mean /= area;
    for (std::size_t f = first; f < first + count; ++f) {
        const Eigen::Vector2d from = facets.centroid[f].head<2>().cast<double>() - mean;
        spread += facets.area[f] * from * from.transpose();
    }
    // The direction of the greatest spread, in closed form.
    const double turn = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
    const Eigen::Vector2d along(std::cos(turn), std::sin(turn)), side(-along.y(), along.x());
    Eigen::AlignedBox3d box;
    for (std::size_t f = first; f < first + count; ++f) {
        for (const std::uint32_t corner : facets.corner[f]) {
            const Eigen::Vector3d v = facets.vertex[corner].cast<double>();
            box.extend(Eigen::Vector3d(v.head<2>().dot(along), v.head<2>().dot(side), v.z()));
        }
    }
    const Eigen::Vector3d centre = box.center();
    return {.middle = centre.x() * along + centre.y() * side,
            .along = along,
            .half_length = 0.5 * box.sizes().x(),
            .half_width = 0.5 * box.sizes().y(),
            .bottom = box.min().z(),
            .top = box.max().z()};
}

BodyBox placed_box(BodyBox box, const Eigen::Isometry3d& pose) {
    if (pose.linear()(2, 2) < 1.0) {  // one of the two does not stand upright
        const double half = 0.5 * (box.top + box.bottom);
        const Eigen::Vector3d there = pose * Eigen::Vector3d(box.middle.x(), box.middle.y(), half);
        box.middle = there.head<2>();
        box.along = (pose.linear() * Eigen::Vector3d(box.along.x(), box.along.y(), 0.0))
                        .head<2>()
                        .normalized();
        box.bottom += there.z() - half;
        box.top += there.z() - half;
        return box;
    }
    const Eigen::Vector3d middle = pose * Eigen::Vector3d(box.middle.x(), box.middle.y(), 0.0);
    box.middle = middle.head<2>();
    box.along = (pose.linear() * Eigen::Vector3d(box.along.x(), box.along.y(), 0.0)).head<2>();
    box.bottom += middle.z();
    box.top += middle.z();
    return box;
}

std::vector<float> wind_at_boxes(const World& world, std::span<const BodyBox> boxes) {
    std::vector<Obstacle> standing =
        obstacles(world, object_parts(world.facets, world.ground_facets));
    const auto first = standing.size();
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        add_obstacle(world, boxes[b], static_cast<std::uint32_t>(b), standing);
    }
    const auto foreign = static_cast<std::ptrdiff_t>(first);
    const Reached reached(standing, world.facets);
    std::vector<float> share(boxes.size());
    for_each_index(
        boxes.size(),
        [&](std::size_t b) {
            const BodyBox& own = boxes[b];
            const Eigen::Vector2d side(-own.along.y(), own.along.x());
            // What stands within it is the object itself.
            const auto outside = [&](const Obstacle& other) {
                if (&other - standing.data() >= foreign && other.body == b) return false;
                const Eigen::Vector2d to = other.box.middle - own.middle;
                return std::abs(to.dot(own.along)) > own.half_length ||
                       std::abs(to.dot(side)) > own.half_width;
            };
            share[b] = reached.share({own.middle.x(), own.middle.y(), 0.5 * (own.bottom + own.top)},
                                     outside);
        },
        16);
    return share;
}

std::string lee_note(const World& world, const std::vector<FilmPart>& parts) {
    std::size_t fewer = 0;
    float least = 1.0f;
    for (std::size_t f = 0; f < std::min(parts.size(), world.ground_facets); ++f) {
        fewer += parts[f].wind < 1.0f ? 1 : 0;
        least = std::min(least, parts[f].wind);
    }
    if (fewer == 0) return "";
    return fmt::format(
        "wind: {:.3g} % of ground facets are in the lee of buildings or objects (mean over all "
        "directions), where the wind speed is reduced to as little as {:.2f} of its value; trees "
        "do not reduce it",
        100.0 * double(fewer) / double(world.ground_facets), least);
}

}  // namespace diurna
