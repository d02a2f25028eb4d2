#include "scenes/commands.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "materials/atmosphere.hpp"
#include "materials/error.hpp"
#include "materials/files.hpp"
#include "materials/library.hpp"
#include "materials/radiosonde.hpp"
#include "materials/scattering.hpp"
#include "materials/units.hpp"
#include "terrain/dem.hpp"
#include "terrain/height_field.hpp"
#include "terrain/object_mesh.hpp"
#include "terrain/parallel.hpp"
#include "terrain/raster_file.hpp"
#include "terrain/sun.hpp"
#include "terrain/triangulate.hpp"
#include "thermal/column_tool.hpp"

namespace diurna {

namespace {

/// Length [km] of the line from one height to another under a zenith angle at its start.
double range_to_height(double from_km, double to_km, double zenith_deg) {
    const double r0 = earth_radius_km + from_km, r1 = earth_radius_km + to_km;
    const double along = r0 * std::cos(radians(zenith_deg));
    const double inside = along * along + r1 * r1 - r0 * r0;
    if (inside >= 0.0) {
        for (const double range : {-along - std::sqrt(inside), -along + std::sqrt(inside)}) {
            if (range > 0.0) return range;
        }
    }
    throw InputError("--to-height-km", fmt::format("a path from {:g} km under zenith angle {:g}° "
                                                   "never reaches {:g} km",
                                                   from_km, zenith_deg, to_km));
}

SightLine line_of(const PathArguments& a, const BandModel& model) {
    const int ends = a.range_km.has_value() + a.to_height_km.has_value() + a.to_ground + a.to_space;
    if (ends != 1) {
        throw InputError("path",
                         fmt::format("found {} ends of the path, expected one of --range-km, "
                                     "--to-height-km, --to-ground, --to-space",
                                     ends));
    }
    if (a.range_km) return sight_line(a.height_km, a.zenith_deg, *a.range_km);
    if (a.to_height_km) {
        return sight_line(a.height_km, a.zenith_deg,
                          range_to_height(a.height_km, *a.to_height_km, a.zenith_deg));
    }
    if (a.to_ground != ends_on_ground(model, a.height_km, a.zenith_deg)) {
        throw InputError(
            a.to_ground ? "--to-ground" : "--to-space",
            fmt::format("a path from {:g} km under zenith angle {:g}° ends {}", a.height_km,
                        a.zenith_deg, a.to_ground ? "in space" : "on the ground"));
    }
    return line_of(model, a.height_km, a.zenith_deg);
}

}  // namespace

void path_command(const PathArguments& arguments) {
    const BandModel model{.profile = named_profile(arguments.profile),
                          .aerosol = arguments.aerosol,
                          .visibility_km = arguments.visibility_km,
                          .co2_ppm = arguments.co2_ppm,
                          .ground_km = arguments.ground_km,
                          .rain_mm_h = arguments.rain_mm_h};
    const Atmosphere atmosphere = model;
    check(atmosphere);
    const SightLine line = line_of(arguments, model);
    std::vector<Band> bands;
    for (const std::string& band : arguments.bands)
        bands.push_back(parse_band(band, bin_edges_um()));

    std::string out = "band_um,transmittance,thermal_path_radiance_W_m2_sr";
    out += arguments.sun_zenith_deg ? ",scattered_sun_W_m2_sr\n" : "\n";
    for (const Band& band : bands) {
        const NodeSpectrum path = path_at_nodes(atmosphere, line, band.node_um);
        out += fmt::format("{:g}-{:g},{:.6f},{:.6g}", band.from_um(), band.to_um(),
                           band_mean_nodes(band, path.transmittance),
                           band_sum_nodes(band, path.radiance));
        if (arguments.sun_zenith_deg) {
            const SunField field(
                model,
                {.zenith_deg = *arguments.sun_zenith_deg, .ground_albedo = arguments.ground_albedo},
                band.node_um);
            const std::vector<double> scattered =
                arguments.to_space
                    ? field.sky(arguments.height_km, arguments.zenith_deg,
                                arguments.azimuth_from_sun_deg)
                    : field.path(line, arguments.zenith_deg, arguments.azimuth_from_sun_deg);
            out += fmt::format(",{:.6g}", band_sum_nodes(band, scattered));
        }
        out += '\n';
    }
    if (!arguments.csv.empty()) {
        const PathSpectrum spectrum = path_spectrum(atmosphere, line);
        const auto edges = bin_edges_um();
        std::string text = "from_um,to_um,transmittance,thermal_path_radiance_W_m2_sr_um\n";
        for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin) {
            text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6g}\n", edges[bin], edges[bin + 1],
                                spectrum.transmittance[bin], spectrum.radiance[bin]);
        }
        write_whole_file(arguments.csv, text);
    }
    fmt::print("{}", out);
}

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
    const Tin tin = affordable_network(dem, arguments.tolerance_m);
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
    const ColumnJob job = read_column_job(file);
    const ColumnResult result = run_column(job);
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
