#include "scenes/commands/raster_commands.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "terrain/ground/affordable_tin.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/objects/ply_file.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/height_field.hpp"
#include "terrain/relief/relief_sky.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "thermal/point/point_csv.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

void sun_command(const SunArguments& arguments) {
    if (!(std::abs(arguments.latitude_deg) <= 90.0)) {
        throw InputError("--latitude-deg",
                         fmt::format("found {:g}, expected -90 to 90", arguments.latitude_deg));
    }
    if (!(std::abs(arguments.longitude_deg) <= 360.0)) {
        throw InputError("--longitude-deg",
                         fmt::format("found {:g}, expected -360 to 360", arguments.longitude_deg));
    }
    const Site site{arguments.latitude_deg, arguments.longitude_deg, arguments.height_m};
    const Instant instant = parse_instant(arguments.time, "--time");
    const SunPosition sun =
        arguments.pressure_hPa
            ? sun_position(site, instant, *arguments.pressure_hPa, arguments.temperature_C)
            : sun_position(site, instant);
    fmt::print("azimuth_deg,elevation_deg,distance_au\n{:.6f},{:.6f},{:.9f}\n", sun.azimuth_deg,
               sun.elevation_deg, sun.distance_au);
}

void mesh_command(const MeshArguments& arguments) {
    const auto begin = std::chrono::steady_clock::now();
    const Dem dem = read_dem(arguments.dem, {.voids = VoidPolicy::fill, .centre = {}});
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

void visibility_command(const VisibilityArguments& arguments) {
    if (arguments.sun_azimuth_deg.has_value() != arguments.sun_elevation_deg.has_value()) {
        throw InputError("visibility",
                         "a sun needs both --sun-azimuth-deg and --sun-elevation-deg");
    }
    const Dem dem = read_dem(arguments.dem, {.voids = VoidPolicy::leave});
    for (const std::string& note : dem.notes) fmt::print(stderr, "note: {}\n", note);
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

void column_command(const std::filesystem::path& file, const std::filesystem::path& out) {
    const PointJob job = read_column_job(file);
    const PointResult result = run_column(job);
    const std::string text = column_csv(result);
    if (out.empty()) {
        fmt::print("{}", text);
        return;
    }
    write_whole_file(out, text);
    fmt::print(stderr, "{} rows, {} passes, periodic to {:.1e} K, energy closed to {:.1e}\n",
               result.row.size(), result.passes, result.periodic_residual,
               result.worst_energy_closure);
}

void doctor_command() {
    const auto has = [](bool there) { return there ? "yes" : "no"; };
    fmt::print("diurna            {}\ncompiler          g++ {}\n", DIURNA_VERSION, __VERSION__);
    fmt::print("libraries         {}\n", DIURNA_LIBRARIES);
    fmt::print("AVX2, FMA         {}, {} (needed)\n", has(__builtin_cpu_supports("avx2")),
               has(__builtin_cpu_supports("fma")));
    fmt::print("AVX-512           {}\n", has(__builtin_cpu_supports("avx512f")));
    fmt::print("threads           {}\n", thread_count());
    const std::filesystem::path data = data_folder();
    fmt::print("data              {} ({})\n", data.string(),
               std::filesystem::is_directory(data) ? "found" : "missing: set DIURNA_DATA");
    fmt::print("materials         {}\n", fmt::join(default_material_library().names(), " "));
    fmt::print("profiles          {}\n", fmt::join(afgl_profile_names(), " "));
    fmt::print("aerosols          {}\n", fmt::join(aerosol_names(), " "));
}

}  // namespace diurna
