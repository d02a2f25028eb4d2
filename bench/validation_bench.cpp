// The README's validation table: every number in it is computed here and now. Prints Markdown.
//
//     ninja -C build/release validation_bench && build/release/validation_bench

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/joint_rows.hpp"
#include "bench/thermal_rows.hpp"
#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "scenes/job/run/heat.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/reflected_sun.hpp"
#include "thermal/point/point_job.hpp"

using namespace diurna;

namespace {

constexpr double pi = std::numbers::pi;

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
    const PathSpectrum found = path_at_nodes(air, sight_line(0.0, 90.0, 5.0), band.node_um);
    return fmt::format("{:+.1f} %",
                       100.0 * (band_mean_nodes(band, found.transmittance) / modtran - 1));
}

/// Mean error of 0.4-0.7, 0.7-1.0 and 1.5-1.8 µm; of one path both ways, or of their product.
std::string reflected_sun(bool product) {
    std::string text;
    for (std::size_t b = 0; b < 3; ++b) {
        const auto errors = lowtran::compare_reflected_sun(lowtran::ranges[b].band(), b);
        const double mean = product ? errors.product.mean() : errors.joined.mean();
        text += fmt::format("{}{:.2f}", b == 0 ? "" : ", ", mean);
    }
    return text + " %";
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
    const FacetViews view = facet_views(facets, RayScene(facets));
    double sum = 0.0, area = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        sum += double(facets.area[f]) * view.sky[f];
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
    row("sun down to the ground and up to an eye, 0.4–0.7, 0.7–1.0, 1.5–1.8 µm",
        "LOWTRAN7, 20 paths", reflected_sun(true) + " the product of both ways",
        [] { return reflected_sun(false); });
    for (const thermal_rows::Case& c : thermal_rows::cases()) {
        row(c.claim, c.reference, c.peers, c.measure);
    }
    for (const thermal_rows::Case& c : joint_rows::cases()) {
        row(c.claim, c.reference, c.peers, c.measure);
    }
    row("Jacksboro raster to 1 m", "each triangle rasterised again",
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
