#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/matter/library.hpp"
#include "render/view/adaptive.hpp"
#include "render/view/observer.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/world/land.hpp"
#include "scenes/world/objects.hpp"
#include "scenes/world/plumes.hpp"
#include "scenes/world/textures.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem_options.hpp"

/// The whole input of a job as plain values: what a scene file says, with units converted, ranges
/// checked and file names resolved. Places are east, north [m] from the site.
namespace diurna {

/// Ground of this slope and height (and not within a named polygon) is of this material.
struct GroundRule {
    std::string material;
    double least_slope_deg = 0.0, most_slope_deg = 90.0;
    double least_height = -1e4, most_height = 1e4;  // above the sea [m]
};

struct GroundPolygon {
    std::string name;
    std::string material;               // "": by the rules, on a finer mesh
    std::vector<Eigen::Vector2d> ring;  // corners, not repeated; east, north [m]
    double largest_edge = 30.0;         // of the triangles within [m]
};

struct Building {
    std::string name;
    Eigen::Vector2d place;  // middle of its plan
    double width, depth, height;
    double heading_deg;  // the way its front faces, clockwise from north
    std::string wall, front, roof;
};

struct TerrainInput {
    std::filesystem::path elevation;
    std::vector<std::filesystem::path> tiles;  // more of it, on the same lattice
    DemOptions reading;
    double tolerance = 1.0;  // vertical [m]
    /// The full grid as quads of two triangles instead of a network within the tolerance: always,
    /// or where it has no more than `most_grid_triangles`.
    enum class Mesh { network, grid, grid_where_it_fits };
    Mesh mesh = Mesh::network;
    static constexpr std::size_t most_grid_triangles = 500'000;
    double refraction = 0.0;  // k of lines of sight (Site)
    double coarsest = 0.0;    // of the tolerance where no observer looks closely; 0: the same [m]
    std::string default_material;
    std::vector<GroundRule> rules;  // the first that fits wins
    std::vector<GroundPolygon> polygons;
    std::vector<Building> buildings;
    std::vector<ObjectInput> objects;
    std::optional<LandCoverInput> land_cover;
    std::vector<ShapesInput> shapes;
};

struct WeatherInput {
    std::filesystem::path file;
    std::string interval = "instant";  // what a time stamp means: start, end or instant
    double wind_height = 10.0, air_height = 2.0;
};

/// The air between surface and eye: an AFGL profile made to meet the weather at the ground, or
/// none, or a table of paths from a file, the same at every instant.
struct AirInput {
    std::filesystem::path table_file;             // "": no table
    std::shared_ptr<const TabulatedPaths> table;  // null: none
    bool vacuum = false;
    std::string profile = "MLS";
    std::string aerosol = "rural";
    double visibility_km = 23.0;
    double co2_ppm = todays_co2_ppm;
    double cloud_base_km = 2.0;  // above the ground
    bool drives_heat = false;    // the heat balance takes its sun and sky from this air
};

struct TimeInput {
    Instant start;
    double duration = 86400.0;  // [s]
    double step = 600.0;        // of the heat balance [s]
    double frame_every = 3600.0;
};

struct ObserverInput {
    std::string name;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    double height_above_ground = 2.0;
    std::optional<Eigen::Vector2d> look_at;  // a point of the ground; else the two angles
    double azimuth_deg = 0.0, elevation_deg = 0.0, roll_deg = 0.0;
    Projection projection = Projection::pinhole;
    double horizontal_fov_deg = 20.0;
    double picture_width = 0.0;  // [m] orthographic
    int width = 640, height = 512;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // east, north, up [m s⁻¹]
    double row_time = 0.0, exposure = 0.0;               // [s]
    int samples = 16;
    std::optional<AdaptiveOptions> adaptive;  // samples where pixels need them
    std::vector<std::string> bands;           // "3-5", "8-12", "lwir", a name of Scene::bands
    std::vector<std::string> cubes;           // names of Scene::cubes
    bool terms = false;                       // planes for the terms of the radiance, one by one
};

struct Scene {
    std::filesystem::path file;
    std::string name;
    std::string title;
    std::optional<Site> site;  // none: the middle of the raster; height NaN: the ground there
    TerrainInput terrain;
    MaterialLibrary materials;  // the program's own with the scene's added
    WeatherInput weather;
    AirInput air;
    TimeInput time;
    std::vector<BandInput> bands;
    std::vector<CubeInput> cubes;
    std::vector<PlumeInput> plumes;
    std::vector<TextureInput> textures;
    TextureUses texture_uses;
    std::vector<ObserverInput> observers;
    int sky_rays = 64;          // per facet of the ground
    int object_sky_rays = 256;  // per facet of buildings and objects
    int sun_samples = 4;        // per facet and instant
    std::uint64_t seed = 1;
};

/// "runway", "hangar", ...: the name of each ObjectId: 0 the ground, then polygons, buildings
/// and objects.
std::vector<std::string> object_names(const Scene& scene);

}  // namespace diurna
