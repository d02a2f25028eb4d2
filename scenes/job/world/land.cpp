#include "scenes/job/world/land.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "materials/base/error.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/land_shapes.hpp"

namespace diurna {

namespace {

/// East and north of a ring in the site's frame, at the ground's height.
std::vector<Eigen::Vector2d> local_ring(const std::vector<Geodetic>& ring, const Dem& dem,
                                        const Site& site) {
    const auto places = raster_places(dem, ring);
    std::vector<Eigen::Vector2d> local;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double height = height_at(dem, places[i]);
        Geodetic corner = ring[i];
        corner.height = std::isnan(height) ? site.height : height;
        local.push_back(to_local(site, corner).head<2>());
    }
    return local;
}

constexpr double tallest = 1000.0;  // [m] building

/// Least and greatest height [m] of the ground at a shape's corners, up in the site's frame; NaN
/// where it is not known at all of them.
std::pair<double, double> ground_at_corners(const LandShape& shape, const Dem& dem,
                                            const Site& site) {
    double lowest = 1e9, highest = -1e9;
    const auto places = raster_places(dem, shape.ring);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double ground = height_at(dem, places[k]);
        const double up =
            to_local(site, {shape.ring[k].latitude_deg, shape.ring[k].longitude_deg, ground}).z();
        if (std::isnan(up)) return {up, up};
        lowest = std::min(lowest, up);
        highest = std::max(highest, up);
    }
    return {lowest, highest};
}

/// Buildings of a file that are not built, for one reason.
struct LeftOut {
    std::size_t count = 0, first = 0;
    void add(const LandShape& shape) {
        if (count++ == 0) first = shape.feature;
    }
    void tell(const ShapesInput& input, const char* why, std::vector<std::string>& notes) const {
        if (count == 0) return;
        notes.push_back(fmt::format("{}: {} building{} {} left out; the first is feature {}",
                                    input.file.string(), count, count == 1 ? "" : "s", why, first));
    }
};

/// A plan by its middle and its area, which do not depend on where its ring begins.
struct PlanPlace {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // east, north [m]
    double area = 0.0;                                 // [m²]
};

PlanPlace plan_place(const Ring& ring) {
    PlanPlace place;
    if (ring.empty()) return place;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        const double twice = a.x() * b.y() - a.y() * b.x();
        place.area += 0.5 * twice;
        place.middle += twice * (a + b) / 6.0;
    }
    if (place.area != 0.0) place.middle /= place.area;
    place.middle += ring[0];
    place.area = std::abs(place.area);
    return place;
}

/// Of buildings on one plan, as where a file or two have it twice, the highest is built; a note
/// reports of the others.
void leave_out_twins(ShapeBuildings& found) {
    constexpr double same_place = 0.5, same_area = 0.02;           // [m]; share
    std::map<std::pair<long, long>, std::vector<std::size_t>> at;  // by the metre
    std::vector<PlanPlace> place;
    std::vector<bool> is_twin(found.building.size(), false);
    std::size_t twins = 0, first = 0;
    for (std::size_t i = 0; i < found.building.size(); ++i) {
        place.push_back(plan_place(found.building[i].prism.ring));
        const auto column = std::lround(place[i].middle.x()),
                   row = std::lround(place[i].middle.y());
        for (long c = column - 1; c <= column + 1; ++c) {
            for (long r = row - 1; r <= row + 1; ++r) {
                for (const std::size_t k : at[{c, r}]) {
                    if (is_twin[k] || is_twin[i] ||
                        (place[k].middle - place[i].middle).norm() > same_place ||
                        std::abs(place[k].area - place[i].area) > same_area * place[i].area) {
                        continue;
                    }
                    const bool lower = found.building[i].prism.top <= found.building[k].prism.top;
                    is_twin[lower ? i : k] = true;
                    if (twins++ == 0) first = lower ? i : k;
                }
            }
        }
        at[{column, row}].push_back(i);
    }
    if (twins == 0) return;
    found.notes.push_back(
        fmt::format("{} building{} with the same plan as another left out (the higher one is "
                    "used); the first is {}",
                    twins, twins == 1 ? "" : "s", found.building[first].prism.where));
    std::vector<ShapeBuilding> kept;
    for (std::size_t i = 0; i < found.building.size(); ++i) {
        if (!is_twin[i]) kept.push_back(std::move(found.building[i]));
    }
    found.building = std::move(kept);
}

bool on_raster(const Ring& ring, const Dem& dem) {
    const bool finite =
        std::all_of(ring.begin(), ring.end(), [](const auto& p) { return p.allFinite(); });
    return finite && ring.size() >= 3 && clipped(ring, dem.columns, dem.rows).size() >= 3;
}

}  // namespace

std::vector<GroundShape> ground_shapes(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                       const Site& site) {
    std::vector<GroundShape> found;
    const auto add = [&](Ring ring, const ShapesInput& input, const std::string& material) {
        if (on_raster(ring, dem)) {
            found.push_back({.footprint = {}, .material = material});
            found.back().footprint.ring = std::move(ring);
            found.back().footprint.largest_edge = input.largest_edge;
        }
    };
    for (const ShapesInput& input : inputs) {
        if (input.buildings) continue;
        for (const LandShape& shape :
             read_shapes(input.file, input.kind_field, "", input.confines, input.layer)) {
            const auto kind = input.material.find(shape.kind);
            const std::string& material =
                kind != input.material.end() ? kind->second : input.default_material;
            if (material.empty()) continue;
            if (shape.line) {
                const auto line = local_ring(shape.ring, dem, site);
                add(raster_places(dem, site, ribbon(line, input.line_width)), input, material);
                continue;
            }
            add(raster_places(dem, shape.ring), input, material);
            for (const auto& hole : shape.hole) add(raster_places(dem, hole), input, "");
        }
    }
    return found;
}

ShapeBuildings shape_buildings(const std::vector<ShapesInput>& inputs, const Dem& dem,
                               const Site& site, double tolerance) {
    ShapeBuildings found;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ShapesInput& input = inputs[i];
        if (!input.buildings) continue;
        LeftOut flat, away;
        for (const LandShape& shape :
             read_shapes(input.file, "", input.height_field, input.confines, input.layer)) {
            if (shape.line) continue;
            const double height =
                std::isnan(shape.height) ? input.default_height : input.level_height * shape.height;
            if (!(height > 0.0)) {
                flat.add(shape);
                continue;
            }
            const std::string where =
                fmt::format("{}: feature {}", input.file.string(), shape.feature);
            check_within(where + ": height", height, 0.0, tallest);
            const auto [lowest, highest] = ground_at_corners(shape, dem, site);
            if (std::isnan(lowest)) {
                away.add(shape);
                continue;
            }
            // Walls reach into the ground, so that no light passes under them; the height counts
            // from the lowest corner.
            std::vector<Ring> courts;
            for (const auto& hole : shape.hole) {
                Ring court = court_of(local_ring(hole, dem, site));
                if (!court.empty()) courts.push_back(std::move(court));
            }
            found.building.push_back({{.ring = local_ring(shape.ring, dem, site),
                                       .hole = std::move(courts),
                                       .bottom = lowest - 1.0 - tolerance,
                                       .top = std::max(lowest + height, highest + 0.1),
                                       .largest_edge = std::max(1.0, input.largest_edge),
                                       .where = where},
                                      i});
        }
        flat.tell(input, "without a height above 0 m", found.notes);
        away.tell(input, "outside the elevation data or on void posts", found.notes);
    }
    leave_out_twins(found);
    return found;
}

}  // namespace diurna
