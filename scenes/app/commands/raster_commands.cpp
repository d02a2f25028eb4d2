#include "scenes/app/commands/raster_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "terrain/ground/affordable_tin.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/ground/triangulate.hpp"
#include "terrain/objects/object_mesh.hpp"
#include "terrain/objects/ply_file.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/height_field.hpp"
#include "terrain/relief/relief_sky.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/point/point_csv.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

namespace {

constexpr const char* outside_says = "permit input files outside the file's folder";

/// Of what lies beside a raster of the command line; none: its own folder.
std::optional<Confines> bounds(bool allow_outside) {
    if (!allow_outside) return std::nullopt;
    return Confines{.folders = {}, .everywhere = true};
}

struct MeshArguments {
    std::filesystem::path dem;
    double tolerance_m = 1.0;
    std::string frame = "enu";  // or grid: (column, row, height) in the raster's own posts
    std::filesystem::path out;  // PLY, if named
    bool allow_outside = false;
};

void mesh_verb(const MeshArguments& arguments) {
    const auto begin = std::chrono::steady_clock::now();
    const FilesRead opened;
    const Dem dem = read_dem(
        arguments.dem,
        {.voids = VoidPolicy::fill, .centre = {}, .confines = bounds(arguments.allow_outside)});
    if (!arguments.out.empty()) check_output_file(arguments.out, opened.files());
    const auto read = std::chrono::steady_clock::now();
    const Tin tin = affordable_tin(dem, arguments.tolerance_m);
    const auto meshed = std::chrono::steady_clock::now();
    const TinCheck found = check_tin(dem, tin);
    if (!arguments.out.empty()) {
        std::vector<Eigen::Vector2d> place;
        std::vector<float> height;
        std::vector<Eigen::Vector3d> vertex;
        for (const auto& [column, row] : tin.post) {
            place.emplace_back(column, row);
            height.push_back(dem.at(row, column));
            vertex.emplace_back(column, row, dem.at(row, column));
        }
        if (arguments.frame == "enu") {
            const Geodetic centre = dem_centre(dem);
            vertex = local_vertices(dem, {centre.latitude_deg, centre.longitude_deg, centre.height},
                                    place, height);
        }
        write_ply(arguments.out, vertex, tin.triangle);
    }
    const auto seconds = [](auto from, auto to) {
        return std::chrono::duration<double>(to - from).count();
    };
    fmt::print(
        "columns,rows,voids,triangles,share_of_grid,worst_error_m,rms_error_m,read_s,mesh_s\n"
        "{},{},{},{},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f}\n",
        dem.columns, dem.rows, dem.voids, tin.triangle.size(),
        static_cast<double>(tin.triangle.size()) /
            std::max(1.0, 2.0 * (dem.columns - 1.0) * (dem.rows - 1.0)),
        found.worst_error, found.rms_error, seconds(begin, read), seconds(read, meshed));
}

struct VisibilityArguments {
    std::vector<std::filesystem::path> dem;  // tiles of one lattice
    int azimuths = 32;
    std::optional<double> sun_azimuth_deg, sun_elevation_deg;
    std::filesystem::path out;  // GeoTIFF, if named: sky view, then sun fraction
    bool allow_outside = false;
};

void visibility_verb(const VisibilityArguments& arguments) {
    if (arguments.sun_azimuth_deg.has_value() != arguments.sun_elevation_deg.has_value()) {
        throw InputError(
            "visibility",
            "found only one of --sun-azimuth-deg and --sun-elevation-deg, expected both");
    }
    const FilesRead opened;
    const Dem dem = read_dem(
        arguments.dem, {.voids = VoidPolicy::leave, .confines = bounds(arguments.allow_outside)});
    if (!arguments.out.empty()) check_output_file(arguments.out, opened.files());
    for (const Mistake& one : dem.warnings) {
        fmt::print(stderr, "warning: {}\n", plain(one.line()));
    }
    for (const std::string& note : dem.notes) fmt::print(stderr, "note: {}\n", plain(note));
    const Geodetic centre = dem_centre(dem);
    const HeightField field =
        height_field(dem, {centre.latitude_deg, centre.longitude_deg, centre.height});
    std::vector<float> seen(field.size()), lit;
    const auto begin = std::chrono::steady_clock::now();
    sky_view(field, arguments.azimuths, seen);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    if (arguments.sun_azimuth_deg) {
        lit.resize(field.size());
        sun_fraction(field, direction(*arguments.sun_azimuth_deg, *arguments.sun_elevation_deg),
                     lit);
    }
    double sky = 0.0, sun = 0.0, least = 1.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (std::isnan(dem.height[i])) {
            seen[i] = std::nanf("");
            if (!lit.empty()) lit[i] = std::nanf("");
            continue;
        }
        sky += seen[i];
        least = std::min(least, double{seen[i]});
        if (!lit.empty()) sun += lit[i];
    }
    const auto posts = static_cast<double>(seen.size() - dem.voids);
    if (!arguments.out.empty()) {
        std::vector<RasterBand> bands{{"sky view", seen}};
        if (!lit.empty()) bands.push_back({"sun fraction", lit});
        write_geotiff(arguments.out, dem, bands);
    }
    fmt::print(
        "columns,rows,voids,azimuths,mean_sky_view,least_sky_view,lit_share,sky_view_s\n"
        "{},{},{},{},{:.5f},{:.5f},{},{:.3f}\n",
        dem.columns, dem.rows, dem.voids, arguments.azimuths, sky / posts, least,
        lit.empty() ? "" : fmt::format("{:.5f}", sun / posts), took.count());
}

}  // namespace

void add_mesh_verb(CLI::App& app) {
    const auto a = std::make_shared<MeshArguments>();
    CLI::App* verb =
        app.add_subcommand("mesh", "triangulate an elevation raster within a vertical tolerance");
    verb->add_option("DEM", a->dem,
                     "elevation raster (GeoTIFF, SRTM, ASCII grid and other GDAL formats)")
        ->required();
    within(verb->add_option("--tolerance-m", a->tolerance_m,
                            "largest vertical distance between mesh and raster"),
           {0.0, 1e4}, "m")
        ->required();
    verb->add_option("--frame", a->frame,
                     "coordinates of the mesh: enu, metres east, north and up of the raster's "
                     "centre; grid, column, row and height (default: enu)")
        ->check(CLI::IsMember({"enu", "grid"}));
    verb->add_option("--out", a->out, "write the mesh to this PLY file");
    verb->add_flag("--allow-outside", a->allow_outside, outside_says);
    verb->callback([a] { mesh_verb(*a); });
}

void add_visibility_verb(CLI::App& app) {
    const auto a = std::make_shared<VisibilityArguments>();
    CLI::App* verb = app.add_subcommand(
        "visibility", "sky view factor and sun visibility at every post of a raster");
    verb->add_option("DEM", a->dem, "elevation raster, or several tiles of one grid")->required();
    whole_within(verb->add_option("--azimuths", a->azimuths,
                                  "azimuths at which the horizon is computed (default: 32)"),
                 4, 4096);
    within(verb->add_option("--sun-azimuth-deg", a->sun_azimuth_deg,
                            "azimuth of the sun, clockwise from north"),
           {-360.0, 360.0});
    within(verb->add_option("--sun-elevation-deg", a->sun_elevation_deg,
                            "elevation of the sun above the horizon"),
           {-90.0, 90.0});
    verb->add_option("--out", a->out, "GeoTIFF of results on the raster's grid");
    verb->add_flag("--allow-outside", a->allow_outside, outside_says);
    verb->callback([a] { visibility_verb(*a); });
}

}  // namespace diurna
