#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/data_folder.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/radiation/planck.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/covered_surfaces.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// An asphalt plain of 100 m from above at noon of a winter's day.
std::string plain() {
    return R"([scene]
sky_rays = 16
[terrain]
elevation = "flat.asc"
material = "asphalt"
[weather]
file = "winter.csv"
[time]
start = 2026-01-10T12:00:00Z
duration_h = 1
step_s = 600
frame_every_s = 3600
[[observer]]
name = "above"
place_m = [0.0, 0.0]
height_above_ground_m = 50.0
azimuth_deg = 0.0
elevation_deg = -90.0
horizontal_fov_deg = 20.0
width = 8
height = 6
bands = ["0.5-0.6", "1.5-1.8", "8-12"]
terms = true
surfaces = 1
)";
}

void write_plain(const std::filesystem::path& folder) {
    std::string raster = "ncols 11\nnrows 11\nxllcorner 500000\nyllcorner 5150000\ncellsize 10\n";
    for (int row = 0; row < 11; ++row) raster += "100 100 100 100 100 100 100 100 100 100 100\n";
    write_text(folder / "flat.asc", raster);
    write_text(folder / "flat.prj",
               "PROJCS[\"UTM 31N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
               "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
               "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
               "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",3],"
               "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
               "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
    std::string weather = "time,air_temperature_K,relative_humidity,wind_speed_m_s\n";
    for (int h = 0; h <= 30; ++h) {
        weather += "2026-01-" + std::to_string(10 + h / 24) + "T" + (h % 24 < 10 ? "0" : "") +
                   std::to_string(h % 24) + ":00:00Z,268,0.6,3\n";
    }
    write_text(folder / "winter.csv", weather);
    write_text(folder / "scene.toml", plain());
}

double mean_of(const Spectrum& s, double from, double to, const auto& weight) {
    double sum = 0.0, all = 0.0;
    for (int i = 0; i < 400; ++i) {
        const double um = from + (i + 0.5) / 400.0 * (to - from);
        sum += weight(um) * s.at(um);
        all += weight(um);
    }
    return sum / all;
}

double median(std::vector<float> pixels) {
    std::nth_element(pixels.begin(), pixels.begin() + std::ptrdiff_t(pixels.size() / 2),
                     pixels.end());
    return double(pixels[pixels.size() / 2]);
}

}  // namespace

// 2026-11: 10 mm of snow on asphalt left every picture as of dry asphalt, reflectance 0.074.
TEST_CASE("a snowed plain looks like snow of its albedo", "[scenes][snow]") {
    const ScratchFolder folder("snow-scene");
    write_plain(folder.path);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const FacetSet& facets = prepared.world.surfaces();
    const Spectrum snow = read_spectrum(data_folder() / "spectra" / "snow_medium.csv");
    TemperatureField field{.instant = {prepared.scene.time.start, prepared.scene.time.end()},
                           .facets = facets.size(),
                           .kelvin = std::vector<float>(2 * facets.size(), 265.0f)};
    field.water.facet.resize(facets.size());
    std::iota(field.water.facet.begin(), field.water.facet.end(), 0u);
    field.water.cover.assign(2 * facets.size(), {0.0f, 1.0f, float(solar_mean(snow))});
    std::filesystem::create_directories(folder.path / "frames");
    Progress silent(ProgressStyle::silent);
    render_frames(Stages(prepared), field, folder.path, silent);
    // The library's spectrum over the bands by hand, under the sun at the ground, or by Planck.
    const Spectrum sun = read_spectrum(data_folder() / "atmosphere" / "sun_at_ground.csv");
    const auto sunlight = [&](double um) { return sun.at(um); };
    const auto heat = [](double um) { return planck(um, 265.0); };
    const auto picture = [&](const char* band) {
        return read_exr(folder.path / "frames" /
                        ("above_" + std::string(band) + "_20260110T120000Z.exr"));
    };
    const Frame green = picture("0.5-0.6"), far_red = picture("1.5-1.8"), warm = picture("8-12");
    CHECK(median(green["reflectance_sun_1.0.5-0.6"].pixel) ==
          Approx(mean_of(snow, 0.5, 0.6, sunlight)).epsilon(0.005));
    CHECK(median(far_red["reflectance_sun_1.1.5-1.8"].pixel) ==
          Approx(mean_of(snow, 1.5, 1.8, sunlight)).epsilon(0.03));
    CHECK(median(warm["emissivity_1.8-12"].pixel) ==
          Approx(1.0 - mean_of(snow, 8.0, 12.0, heat)).margin(0.001));
    // What is reported is what was used; the material is the scene's.
    CHECK(median(warm["snow_cover"].pixel) == 1.0);
    CHECK(median(warm["snow_albedo"].pixel) == Approx(solar_mean(snow)).margin(1e-6));
    const MaterialId asphalt = prepared.scene.materials.find("asphalt");
    CHECK(median(warm["material"].pixel) == double(index(asphalt)));
    CHECK(median(warm["material_1"].pixel) == double(index(asphalt)));
}

TEST_CASE("facets under snow of many depths are few materials near their albedo",
          "[scenes][snow]") {
    const ScratchFolder folder("snow-states");
    write_plain(folder.path);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const FacetSet& facets = prepared.world.surfaces();
    std::vector<std::uint32_t> facet(facets.size());
    std::iota(facet.begin(), facet.end(), 0u);
    std::vector<SurfaceCover> cover;
    for (const std::uint32_t f : facet) {
        const float x = float(f) / float(facet.size());
        cover.push_back({0.0f, x, 0.6f + 0.25f * x});
    }
    const auto covered = covered_surfaces(facets, prepared.scene.materials, facet, cover);
    REQUIRE(covered);
    CHECK(covered->states <= CoveredSurfaces::most_states);
    // Half a step of 1/64 in share, at a contrast of 0.77, and in albedo.
    CHECK(covered->widest < 0.5 / 64.0 * (0.77 + 1.0) + 1e-3);
    double area = 0.0, own = 0.0, shown = 0.0;
    for (const std::uint32_t f : facet) {
        const double a = double(facets.area[f]);
        own += a * covered_albedo(prepared.scene.materials[facets.material[f]].thermal, cover[f]);
        shown += a * solar_mean(covered->materials[covered->facets.material[f]].reflectance);
        area += a;
    }
    CHECK(shown / area == Approx(own / area).epsilon(0.01));
    std::fill(cover.begin(), cover.end(), SurfaceCover{0.9f, 0.0f, 0.0f});
    // Wet, but no darker for it.
    std::vector<Material> dull(prepared.scene.materials.size());
    for (std::size_t m = 0; m < dull.size(); ++m) dull[m].name = std::to_string(m);
    CHECK_FALSE(covered_surfaces(facets, MaterialLibrary(std::move(dull)), facet, cover));
}
