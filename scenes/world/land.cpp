#include "scenes/world/land.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

constexpr double tallest = 2000.0;  // [m] building

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
        notes.push_back(fmt::format("{}: {} building{} {} left out, the first is feature {}",
                                    input.file.string(), count, count == 1 ? "" : "s", why, first));
    }
};

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
             read_shapes(input.file, input.kind_field, "", input.confines)) {
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
             read_shapes(input.file, "", input.height_field, input.confines)) {
            if (shape.line) continue;
            const double height = std::isnan(shape.height) ? input.default_height : shape.height;
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
            found.building.push_back({{.ring = local_ring(shape.ring, dem, site),
                                       .bottom = lowest - 1.0 - tolerance,
                                       .top = std::max(lowest + height, highest + 0.1),
                                       .largest_edge = std::max(1.0, input.largest_edge),
                                       .where = where},
                                      i});
        }
        flat.tell(input, "without a height above 0 m", found.notes);
        away.tell(input, "beyond the elevation data or on void posts", found.notes);
    }
    return found;
}

}  // namespace diurna
