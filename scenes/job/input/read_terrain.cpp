#include "scenes/job/input/read_terrain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Corners of a rectangle about a place [m]: spec has its length, width and the heading of its
/// length after two numbers.
std::vector<Eigen::Vector2d> rectangle(const Eigen::Vector2d& centre,
                                       const std::vector<double>& spec) {
    const double heading = radians(spec[4]);
    const Eigen::Vector2d along =
        0.5 * spec[2] * Eigen::Vector2d(std::sin(heading), std::cos(heading));
    const Eigen::Vector2d right =
        0.5 * spec[3] * Eigen::Vector2d(std::cos(heading), -std::sin(heading));
    return {centre - along - right, centre - along + right, centre + along + right,
            centre + along - right};
}

constexpr double furthest = 1e6;  // [m] from the site

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// What a ring cannot be: too large, without area, crossing itself.
void check_ring(const Section& section, const std::string& key,
                const std::vector<Eigen::Vector2d>& ring) {
    constexpr std::size_t most_corners =
        10000;  // of a ring: every side is held against every other
    const std::size_t n = ring.size();
    if (n < 3 || n > most_corners) {
        if (n > 3) {
            section.mistake(key,
                            fmt::format("found {} corners, expected at most {}", n, most_corners));
        }
        return;
    }
    double area = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(ring[i].cwiseAbs().maxCoeff() <= furthest)) {
            section.mistake(
                key,
                fmt::format("found a corner at [{:g}, {:g}], expected at most {:g} m from the site",
                            ring[i].x(), ring[i].y(), furthest));
            return;
        }
        if (i > 1) area += 0.5 * turn(ring[0], ring[i - 1], ring[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % n];
        for (std::size_t k = i + 2; k < n && (i > 0 || k + 1 < n); ++k) {
            const Eigen::Vector2d &c = ring[k], &d = ring[(k + 1) % n];
            if (turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0) {
                section.mistake(
                    key,
                    fmt::format("its side from corner {} crosses the one from corner {}", i + 1,
                                k + 1),
                    "give the corners in order along the border");
                return;
            }
        }
    }
    if (!(std::abs(area) > 1e-4)) section.mistake(key, "has no area");
}

/// The key that says where it lies: one of four.
std::string border_key(const Section& section) {
    std::string found = "ring_m";
    int given = 0;
    for (const char* key : {"ring", "rectangle", "ring_m", "rectangle_m"}) {
        if (!section.has(key)) continue;
        found = key;
        if (++given == 2) {
            section.mistake(
                key, "found two borders, expected one of ring_m, rectangle_m, ring, rectangle");
        }
    }
    return found;
}

/// Corners, east and north [m].
///
/// - heading_deg: becomes that of a rectangle
std::vector<Eigen::Vector2d> read_border(const Section& section, const ScenePlaces& places,
                                         const std::string& key, double& heading_deg) {
    if (key == "ring") {
        return places.all(
            section, "ring",
            section.rows(
                "ring",
                "[[latitude, longitude], ...] instead of ring_m, or in the CRS of place_crs", 2,
                3));
    }
    if (key == "ring_m") {
        std::vector<Eigen::Vector2d> ring;
        for (const auto& corner : section.rows(
                 "ring_m", "[[east, north], ...]: corners in order, the first one not repeated", 2,
                 3)) {
            ring.emplace_back(corner[0], corner[1]);
        }
        return ring;
    }
    const bool mapped = key == "rectangle", sound = !section.has_mistakes();
    const std::vector<double> spec = section.numbers(
        key,
        mapped ? "[latitude, longitude, length, width, heading_deg] instead of rectangle_m, the "
                 "first two in the CRS of place_crs, the others in metres and degrees"
               : "[east, north, length, width, heading_deg]: centre, sides, direction of the "
                 "length; or give ring_m",
        5);
    if (sound && section.has_mistakes()) return {};  // no five numbers, which is reported
    if (!(spec[2] > 0.0 && spec[3] > 0.0 && std::abs(spec[4]) <= 360.0)) {
        section.mistake(key, fmt::format("expected [{}, length > 0, width > 0, heading_deg of "
                                         "-360 to 360]",
                                         mapped ? "latitude, longitude" : "east, north"));
    }
    heading_deg = spec[4];
    if (!mapped) return rectangle({spec[0], spec[1]}, spec);
    if (section.has_mistakes()) return {};
    return rectangle(places.all(section, "rectangle", {spec}).front(), spec);
}

GroundPolygon read_polygon(const Section& section, Reading& reading) {
    GroundPolygon polygon;
    polygon.name = reading.object(section, "name of the object that this ground forms");
    polygon.kind = class_of(section, {polygon.name, "name"});
    polygon.material = section.name_or(
        "material", "material of the ground inside; without it as the rules give, on a finer mesh",
        "", reading.materials);
    reading.texture(section, reading.texture_uses.of_object, polygon.name);
    polygon.largest_edge = section.number_or(
        "largest_edge_m", "largest edge of the triangles inside", 30.0, {1.0, 1e4});
    const std::string key = border_key(section);
    const bool sound = !section.has_mistakes();
    polygon.ring = read_border(section, reading.places, key, polygon.heading_deg);
    if (sound && section.has_mistakes()) polygon.ring.clear();  // reported
    polygon.where = section.where(key);
    check_ring(section, key, polygon.ring);
    return polygon;
}

Building read_building(const Section& section, Reading& reading) {
    Building building;
    building.name = reading.object(section, "name of the object");
    building.kind = class_of(section, "building");
    reading.texture(section, reading.texture_uses.of_object, building.name);
    building.place =
        reading.places.one(section, {"place_m", "place"}, "place of the centre of its plan");
    building.width = section.number("width_m", "width of its front", {0.5, 1000.0});
    building.depth = section.number("depth_m", "depth from its front to its back", {0.5, 1000.0});
    building.height =
        section.number("height_m", "height above the ground at its centre", {0.5, 500.0});
    building.heading_deg = section.number_or(
        "heading_deg", "direction of its front, clockwise from north", 180.0, {-360.0, 360.0});
    building.wall = section.name("wall", "material of its walls", reading.materials);
    const Or<std::string> as_wall{building.wall, "wall"};
    building.front =
        section.name_or("front", "material of its front wall", as_wall, reading.materials);
    building.roof =
        section.name_or("roof", "material of its flat roof", as_wall, reading.materials);
    return building;
}

GroundRule read_rule(const Section& rule, const Reading& reading) {
    const auto slope =
        rule.numbers_or("slope_deg", "[least, most] slope of the ground that it applies to",
                        std::vector{0.0, 90.0}, 2);
    const auto height =
        rule.numbers_or("height_m", "[least, most] height above the sea that it applies to",
                        std::vector{-1e4, 1e4}, 2);
    if (!(slope[0] < slope[1] && slope[0] >= -90.0 && slope[1] <= 90.0)) {
        rule.mistake("slope_deg", "expected [least, most] in ascending order, at most 90");
    }
    if (!(height[0] < height[1] && height[0] >= -1e5 && height[1] <= 1e5)) {
        rule.mistake("height_m", "expected [least, most] in ascending order, within 100000 m");
    }
    return {.material = rule.name("material", "material of this ground", reading.materials),
            .least_slope_deg = slope[0],
            .most_slope_deg = slope[1],
            .least_height = height[0],
            .most_height = height[1]};
}

/// The mesh of the elevation and what covers it where nothing else does.
void read_ground(const Section& section, Reading& reading, TerrainInput& terrain) {
    using Mesh = TerrainInput::Mesh;
    terrain.coarsest = section.number_or(
        "coarsest_m",
        "largest tolerance far from all observers; it grows with distance to at most one pixel",
        {0.0, "tolerance_m"}, {0.0, 1000.0});
    terrain.mesh = section.choice_or(
        "mesh",
        "network: triangles within the tolerance; grid: every post; auto: every post if this gives "
        "at most half a million triangles",
        Mesh::network,
        {{"network", Mesh::network}, {"grid", Mesh::grid}, {"auto", Mesh::grid_where_it_fits}});
    terrain.default_material = section.name(
        "material", "material of ground that no table below covers", reading.materials);
    reading.texture(section, reading.texture_uses.of_object, "ground");
    for (const Section& rule : section.sections(
             "rule",
             "material of ground by slope and height; the first rule that applies is used")) {
        terrain.rules.push_back(read_rule(rule, reading));
    }
    if (section.has("land_cover")) {
        for (const Section& cover : section.one_or_more_sections(
                 "land_cover",
                 "classes of a raster with materials for some of them; used before the rules. With "
                 "several tables, [[terrain.land_cover]], the first that has a material for the "
                 "class is used")) {
            terrain.land_cover.push_back(read_land_cover(cover, reading));
        }
    }
}

}  // namespace

TerrainInput read_terrain(const Section& section, const Section& root, Reading& reading,
                          ElevationInput elevation) {
    TerrainInput terrain;
    terrain.elevation = std::move(elevation);
    read_ground(section, reading, terrain);
    for (const Section& polygon : root.sections(
             "ground", "a part of the ground with its own border; later ones lie on top")) {
        terrain.polygons.push_back(read_polygon(polygon, reading));
    }
    for (const Section& building : root.sections("building", "a box with a flat roof")) {
        terrain.buildings.push_back(read_building(building, reading));
    }
    for (const Section& object :
         root.sections("object", "a mesh on the ground; the ground around it is refined")) {
        for (ObjectInput& one : read_object(object, reading)) {
            terrain.objects.push_back(std::move(one));
        }
    }
    for (const Section& shapes :
         root.sections("shapes",
                       "polygons and lines of a vector file: ground of a material, roads, or "
                       "buildings where wall or roof is given")) {
        terrain.shapes.push_back(read_shapes_input(shapes, reading));
    }
    return terrain;
}

}  // namespace diurna
