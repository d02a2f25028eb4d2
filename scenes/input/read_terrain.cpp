#include "scenes/input/read_terrain.hpp"

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
            section.mistake(key, fmt::format("found a corner at [{:g}, {:g}], expected {:g} m from "
                                             "the site at most",
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
                section.mistake(key,
                                fmt::format("its side from corner {} crosses that from corner "
                                            "{}",
                                            i + 1, k + 1),
                                "corners one after the other, as one walks round it");
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
            section.mistake(key,
                            "stands beside another border, expected one of ring_m, rectangle_m, "
                            "ring, rectangle");
        }
    }
    return found;
}

/// Corners, east and north [m].
std::vector<Eigen::Vector2d> read_border(const Section& section, const ScenePlaces& places,
                                         const std::string& key) {
    if (key == "ring") {
        return places.all(section, "ring",
                          section.rows("ring",
                                       "in place of ring_m: [[latitude, longitude], ...], or as "
                                       "place_crs says",
                                       2, 3));
    }
    if (key == "ring_m") {
        std::vector<Eigen::Vector2d> ring;
        for (const auto& corner : section.rows(
                 "ring_m", "[[east, north], ...]: its corners in turn, the first not repeated", 2,
                 3)) {
            ring.emplace_back(corner[0], corner[1]);
        }
        return ring;
    }
    const bool mapped = key == "rectangle", sound = !section.has_mistakes();
    const std::vector<double> spec = section.numbers(
        key,
        mapped ? "in place of rectangle_m: [latitude, longitude, length, width, heading_deg], the "
                 "first two as place_crs says, the others in metres and degrees"
               : "[east, north, length, width, heading_deg]: middle, sides, the way its length "
                 "points; or ring_m",
        5);
    if (sound && section.has_mistakes()) return {};  // no five numbers, which is reported
    if (!(spec[2] > 0.0 && spec[3] > 0.0 && std::abs(spec[4]) <= 360.0)) {
        section.mistake(key, fmt::format("expected [{}, length > 0, width > 0, heading_deg of "
                                         "-360 to 360]",
                                         mapped ? "latitude, longitude" : "east, north"));
    }
    if (!mapped) return rectangle({spec[0], spec[1]}, spec);
    if (section.has_mistakes()) return {};
    return rectangle(places.all(section, "rectangle", {spec}).front(), spec);
}

GroundPolygon read_polygon(const Section& section, Reading& reading) {
    GroundPolygon polygon;
    polygon.name = reading.object(section, "of the object that this ground is");
    polygon.kind = class_of(section, {polygon.name, "name"});
    polygon.material = section.name_or(
        "material", "of the ground within; without one it is as the rules say, on a finer mesh", "",
        reading.materials);
    reading.texture(section, reading.texture_uses.of_object, polygon.name);
    polygon.largest_edge =
        section.number_or("largest_edge_m", "of the triangles within", 30.0, {1.0, 1e4});
    const std::string key = border_key(section);
    const bool sound = !section.has_mistakes();
    polygon.ring = read_border(section, reading.places, key);
    if (sound && section.has_mistakes()) polygon.ring.clear();  // reported
    polygon.where = section.where(key);
    check_ring(section, key, polygon.ring);
    return polygon;
}

Building read_building(const Section& section, Reading& reading) {
    Building building;
    building.name = reading.object(section, "of the object that it is");
    building.kind = class_of(section, "building");
    reading.texture(section, reading.texture_uses.of_object, building.name);
    building.place = reading.places.one(section, {"place_m", "place"}, "of the middle of its plan");
    building.width = section.number("width_m", "of its front", {0.5, 1000.0});
    building.depth = section.number("depth_m", "from its front to its back", {0.5, 1000.0});
    building.height = section.number("height_m", "above the ground at its middle", {0.5, 500.0});
    building.heading_deg = section.number_or(
        "heading_deg", "the way its front faces, clockwise from north", 180.0, {-360.0, 360.0});
    building.wall = section.name("wall", "of its walls", reading.materials);
    const Or<std::string> as_wall{building.wall, "wall"};
    building.front = section.name_or("front", "of its front wall", as_wall, reading.materials);
    building.roof = section.name_or("roof", "of its flat roof", as_wall, reading.materials);
    return building;
}

GroundRule read_rule(const Section& rule, const Reading& reading) {
    const auto slope = rule.numbers_or("slope_deg", "[least, most] of the ground it holds for",
                                       std::vector{0.0, 90.0}, 2);
    const auto height = rule.numbers_or("height_m", "[least, most] above the sea it holds for",
                                        std::vector{-1e4, 1e4}, 2);
    if (!(slope[0] < slope[1] && slope[0] >= -90.0 && slope[1] <= 90.0)) {
        rule.mistake("slope_deg", "expected [least, most] in ascending order, at most 90");
    }
    if (!(height[0] < height[1] && height[0] >= -1e5 && height[1] <= 1e5)) {
        rule.mistake("height_m", "expected [least, most] in ascending order, within 100000 m");
    }
    return {.material = rule.name("material", "of such ground", reading.materials),
            .least_slope_deg = slope[0],
            .most_slope_deg = slope[1],
            .least_height = height[0],
            .most_height = height[1]};
}

/// The mesh of the elevation and what covers it where nothing else does.
void read_ground(const Section& section, Reading& reading, TerrainInput& terrain) {
    using Mesh = TerrainInput::Mesh;
    terrain.coarsest = section.number_or(
        "coarsest_m", "the tolerance where no observer looks closely, a pixel at most",
        {0.0, "tolerance_m"}, {0.0, 1000.0});
    terrain.mesh = section.choice_or(
        "mesh",
        "network: triangles within the tolerance; grid: every post; auto: every post where that "
        "makes no more than half a million triangles",
        Mesh::network,
        {{"network", Mesh::network}, {"grid", Mesh::grid}, {"auto", Mesh::grid_where_it_fits}});
    terrain.default_material =
        section.name("material", "of ground where nothing below says otherwise", reading.materials);
    reading.texture(section, reading.texture_uses.of_object, "ground");
    for (const Section& rule : section.sections(
             "rule", "ground of a slope and height is of a material; the first that fits wins")) {
        terrain.rules.push_back(read_rule(rule, reading));
    }
    if (section.has("land_cover")) {
        for (const Section& cover : section.one_or_more_sections(
                 "land_cover",
                 "classes of another raster, with a material for some; before the rules. Of "
                 "several "
                 "tables, [[terrain.land_cover]], the first that knows a material wins")) {
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
             "ground", "a piece of ground with a border of its own; later ones lie on top")) {
        terrain.polygons.push_back(read_polygon(polygon, reading));
    }
    for (const Section& building : root.sections("building", "a box with a flat roof")) {
        terrain.buildings.push_back(read_building(building, reading));
    }
    for (const Section& object : root.sections(
             "object", "a mesh that stands on the ground, which is made fine around it")) {
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
