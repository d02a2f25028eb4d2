// The README's validation table: every number in it is computed here and now. Prints Markdown.
//
//     ninja -C build/release validation_bench && build/release/validation_bench

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "materials/atmosphere.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "terrain/ground_mesh.hpp"
#include "terrain/sun.hpp"
#include "terrain/visibility.hpp"
#include "thermal/column_tool.hpp"

using namespace diurna;

namespace {

constexpr double day = 86400.0, pi = std::numbers::pi;

struct Row {
    std::string claim, reference, error, peers;
    double seconds;
};

std::vector<Row> rows;

/// Runs `measure`, which returns our error as a text, and notes how long it took.
void row(const std::string& claim, const std::string& reference, const std::string& peers,
         const std::function<std::string()>& measure) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string error = measure();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    rows.push_back({claim, reference, error, peers, spent.count()});
}

std::string sun() {
    const SunPosition sun = sun_position({39.742476, -105.1786, 1830.14},
                                         parse_instant("2003-10-17T12:30:30-07:00"), 820.0, 11.0);
    return fmt::format("{:.5f}°", std::max(std::abs(90.0 - sun.elevation_deg - 50.11162),
                                           std::abs(sun.azimuth_deg - 194.34024)));
}

std::string band_radiance_error() {
    double worst = 0.0;
    for (const auto& [band, exact] : {std::pair{"3-5", 1.86595620816}, {"8-12", 38.5004239333}}) {
        worst = std::max(worst, std::abs(band_radiance(parse_band(band), 300.0) / exact - 1.0));
    }
    return fmt::format("{:.1e} relative", worst);
}

std::string path(const std::string& band_um, double modtran) {
    const BandModel air{.profile = afgl_profile("TROP"),
                        .aerosol = "rural",
                        .visibility_km = 23.0,
                        .co2_ppm = 360.0};
    const Band band = parse_band(band_um, bin_edges_um());
    const NodeSpectrum found = path_at_nodes(air, sight_line(0.0, 90.0, 5.0), band.node_um);
    return fmt::format("{:+.1f} %",
                       100.0 * (band_mean_nodes(band, found.transmittance) / modtran - 1));
}

/// A horizontal facet over a half-space of k = 1, C = 2e6 that only exchanges by film and
/// radiation.
ColumnJob half_space(double film, double emissivity) {
    ColumnJob job;
    job.surface.albedo = 0.0;
    job.surface.emissivity = emissivity;
    job.surface.convection = ConstantFilm{film};
    job.surface.layers = {{4.0, 1.0, 2000.0, 1000.0}};
    job.surface.bottom = FixedFlux{0.0};
    job.start = parse_instant("2020-06-01T00:00:00Z");
    job.end = later(job.start, day);
    job.spin_up = SpinUp::periodic;
    return job;
}

void drive(ColumnJob& job, const std::function<double(double)>& sun,
           const std::function<double(double)>& air, double longwave) {
    for (double t = 0.0; t <= day + 1.0; t += 300.0) {
        Forcing forcing;
        forcing.air.temperature = air(t);
        forcing.shortwave_down = sun(t);
        forcing.longwave_down = longwave;
        job.weather.instant.push_back(later(job.start, t));
        job.weather.sample.push_back(forcing);
    }
}

std::string desert_day() {
    ColumnJob job = half_space(10.0, 0.95);
    job.step = 1800.0;
    drive(
        job, [](double t) { return 750.0 * std::max(0.0, -std::cos(2.0 * pi * t / day)); },
        [](double t) { return 298.15 + 8.0 * std::cos(2.0 * pi * (t - 54000.0) / day); }, 330.0);
    const ColumnResult result = run_column(job);
    double worst = 0.0;
    for (const auto& [hour, kelvin] : std::vector<std::pair<double, double>>{
             {1, 294.1009},  {3, 292.5792},    {5, 292.0031},    {6, 292.0728},  {6.5, 293.8714},
             {7, 296.6394},  {8, 303.1838},    {9, 309.9751},    {10, 316.1945}, {11, 321.2634},
             {12, 324.7690}, {12.5, 325.8470}, {13, 326.4450},   {14, 326.1607}, {15, 323.9119},
             {16, 319.8125}, {18, 307.0559},   {18.5, 304.8424}, {19, 303.3794}, {20, 301.1737},
             {21, 299.3915}, {22, 297.8266},   {24, 295.1737}}) {
        worst = std::max(worst,
                         std::abs(result.row[std::size_t(hour * 2)].surface_temperature - kelvin));
    }
    return fmt::format("{:.3f} K worst, energy to {:.0e}", worst, result.worst_energy_closure);
}

std::string half_space_wave() {
    double worst = 0.0;
    for (const auto& [film, amplitude] :
         {std::pair{5.0, 6.253404513}, {15.0, 3.995923739}, {30.0, 2.534198955}}) {
        ColumnJob job = half_space(film, 0.0);
        job.step = 600.0;
        drive(
            job, [](double t) { return 100.0 + 100.0 * std::cos(2.0 * pi * t / day); },
            [](double) { return 290.0; }, 0.0);
        const ColumnResult result = run_column(job);
        std::complex<double> sum = 0.0;
        const std::size_t n = result.row.size() - 1;
        for (std::size_t i = 0; i < n; ++i) {
            sum += result.row[i].surface_temperature *
                   std::polar(2.0 / double(n), -2.0 * pi * double(i) / double(n));
        }
        worst = std::max(worst, std::abs(std::abs(sum) / amplitude - 1.0));
    }
    return fmt::format("{:.3f} % in amplitude", 100.0 * worst);
}

std::string radiating_half_space() {
    ColumnJob job = half_space(0.0, 1.0);
    job.spin_up = SpinUp::none;
    job.initial_temperature = 300.0;
    job.step = 60.0;
    drive(
        job, [](double) { return 0.0; }, [](double) { return 290.0; }, 0.0);
    const ColumnResult result = run_column(job);
    double worst = 0.0;
    for (const auto& [t, kelvin] :
         {std::pair{600.0, 291.77910574}, {3600.0, 281.96186568}, {21600.0, 264.2939807}}) {
        worst = std::max(worst,
                         std::abs(result.row[std::size_t(t / 60.0)].surface_temperature - kelvin));
    }
    return fmt::format("{:.4f} K", worst);
}

std::string mesh(double tolerance) {
    const Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    const GroundMesh ground = ground_mesh(dem, tolerance);
    const TinCheck found = check_ground_mesh(dem, ground);
    return fmt::format("{:.3f} m worst, {} posts uncovered, {} triangles", found.worst_error,
                       found.uncovered_posts, ground.triangle.size());
}

/// A spherical cap of depth over diameter q, as a mesh of rings; every facet sees the sky by 1 − f,
/// f = 4q² / (1 + 4q²).
std::string bowl(double q) {
    constexpr int rings = 60, sectors = 240;
    constexpr double rim = 100.0;
    const double depth = 2.0 * q * rim, sphere = (rim * rim + depth * depth) / (2.0 * depth);
    const double opening = std::asin(rim / sphere);
    std::vector<Eigen::Vector3d> vertex{{0.0, 0.0, 0.0}};
    for (int r = 1; r <= rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const double polar = opening * r / rings, azimuth = 2.0 * pi * s / sectors;
            vertex.emplace_back(sphere * std::sin(polar) * std::cos(azimuth),
                                sphere * std::sin(polar) * std::sin(azimuth),
                                sphere * (1.0 - std::cos(polar)));
        }
    }
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const auto at = [](int r, int s) {
        return r == 0 ? 0u : static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            triangle.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
            if (r > 0) triangle.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
    const SkyView view = sky_view(facets, RayScene(facets));
    double sum = 0.0, area = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        sum += double(facets.area[f]) * view.sky_view[f];
        area += facets.area[f];
    }
    return fmt::format("{:+.4f}", sum / area - 1.0 / (1.0 + 4.0 * q * q));
}

}  // namespace

int main() {
    row("the sun's place", "NREL SPA example (Reda & Andreas 2004)",
        "0.38° libnova without precession, 0.75° Spencer's series", sun);
    row("band radiance at 300 K, 3–5 and 8–12 µm", "Planck's law to 40 digits", "",
        band_radiance_error);
    row("transmittance 3.5–4.1 µm, tropical 5 km level, rural 23 km", "MODTRAN 5: 0.6365",
        "LOWTRAN7 −19 %", [] { return path("3.5-4.1", 0.6365); });
    row("transmittance 3–5 µm, same path", "MODTRAN 5: 0.2772", "LOWTRAN7 −17 %",
        [] { return path("3-5", 0.2772); });
    row("transmittance 8–12 µm, same path", "MODTRAN 5: 0.1535", "LOWTRAN7 +1.6 %",
        [] { return path("8-12", 0.1535); });
    row("half-space under a periodic flux, films of 5, 15, 30 W/m²K", "Carslaw & Jaeger 2.6",
        "0.7 % a 15-node column (first cell 0.1 skin depths)", half_space_wave);
    row("half-space that radiates from 300 K to 0 K, 60 s steps",
        "Abel/Volterra equation, 8 digits", "", radiating_half_space);
    row("desert day, periodic, 30-minute output", "CVODE method of lines, extrapolated",
        "0.069 K an 18-layer finite-volume column", desert_day);
    row("Jacksboro raster to 1 m", "each triangle rasterised anew",
        "tin-terrain 572 m at 10 m allowed; martini 9.5 m at 5 m", [] { return mesh(1.0); });
    row("sky view in a bowl, depth/diameter 0.1, 0.2, 0.5, mean", "spherical cap, exact",
        "HORAYZON +0.0013, topocalc 0.0021 rms at 0.2",
        [] { return bowl(0.1) + ", " + bowl(0.2) + ", " + bowl(0.5); });

    fmt::print("| claim | reference | our error | others | seconds |\n|---|---|---|---|---|\n");
    for (const Row& r : rows) {
        fmt::print("| {} | {} | {} | {} | {:.2g} |\n", r.claim, r.reference, r.error, r.peers,
                   r.seconds);
    }
}
