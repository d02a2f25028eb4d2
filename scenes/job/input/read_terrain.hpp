#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/job/input/checked_names.hpp"
#include "scenes/job/input/read_elevation.hpp"
#include "scenes/job/input/read_land.hpp"
#include "scenes/job/input/read_object.hpp"

namespace diurna {

/// Ground with this slope and height (outside named polygons) has this material.
struct GroundRule {
    std::string material;
    double least_slope_deg = 0.0, most_slope_deg = 90.0;
    double least_height = -1e4, most_height = 1e4;  // above the sea [m]
};

struct GroundPolygon {
    std::string name;
    std::string kind;                   // its class in labels
    std::string material;               // "": by the rules, on a finer mesh
    std::vector<Eigen::Vector2d> ring;  // corners, not repeated; east, north [m]
    double heading_deg = 0.0;           // of a rectangle's length, clockwise from north
    double largest_edge = 30.0;         // of the triangles within [m]
    std::string where;                  // of its corners in the scene file
};

struct Building {
    std::string name;
    std::string kind;       // its class in labels
    Eigen::Vector2d place;  // middle of its plan
    double width, depth, height;
    double heading_deg;  // direction its front faces, clockwise from north
    std::string wall, front, roof;
    double largest_edge = 3.0, foot_edge = 0.5;  // [m] of its facets; at the foot of its walls
};

struct TerrainInput {
    ElevationInput elevation;
    /// The full grid as quads of two triangles instead of a network within the tolerance, on
    /// details every post: always, or if it has at most `most_grid_triangles`.
    enum class Mesh { network, grid, grid_where_it_fits };
    Mesh mesh = Mesh::network;
    static constexpr std::size_t most_grid_triangles = 500'000;
    double coarsest = 0.0;  // tolerance far from all observers; 0: the same [m]
    std::string default_material;
    std::vector<GroundRule> rules;  // the first that matches is used
    std::vector<GroundPolygon> polygons;
    std::vector<Building> buildings;
    std::vector<ObjectInput> objects;
    std::vector<LandCoverInput> land_cover;  // the first with a material is used
    std::vector<ShapesInput> shapes;
};

/// The section [terrain] and the tables placed on it: [[ground]], [[building]], [[object]],
/// [[shapes]].
///
/// - elevation: read_elevation_keys() of the section
TerrainInput read_terrain(const Section& section, const Section& root, Reading& reading,
                          ElevationInput elevation);

}  // namespace diurna
