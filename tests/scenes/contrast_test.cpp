#include "scenes/studies/contrast.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/radiation/planck.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/studies/air_on_line.hpp"
#include "scenes/studies/contrast_files.hpp"
#include "scenes/studies/contrast_on_line.hpp"
#include "tests/support/black_plain.hpp"

using namespace diurna;

// Black plates of known warmth on a black plain in a vacuum, where pictures show what they are.

namespace {

constexpr double warm = 310.0, cold = 296.0, plain = 300.0;  // [K]

std::string plates(const std::string& more) {
    return black_plain(R"(
[[ground]]
name = "warm plate"
material = "black"
rectangle_m = [-12.3, 0.4, 12.0, 9.0, 0.0]
largest_edge_m = 6.0
[[ground]]
name = "cold plate"
material = "black"
rectangle_m = [4.1, 0.2, 12.0, 9.0, 0.0]
largest_edge_m = 6.0
[[observer]]
name = "drone"
place_m = [0.0, 0.0]
height_above_ground_m = 60.0
azimuth_deg = 0.0
elevation_deg = -90.0
horizontal_fov_deg = 60.0
width = 96
height = 64
samples = 16
bands = ["8-12", "3-5"]
[[observer]]
name = "aside"
place_m = [0.0, 300.0]
height_above_ground_m = 2.0
azimuth_deg = 0.0
elevation_deg = 45.0
horizontal_fov_deg = 10.0
width = 32
height = 32
samples = 4
bands = ["8-12"]
)" + more);
}

TemperatureField of_plates(const Prepared& prepared) {
    const FacetSet& surfaces = prepared.world.surfaces();
    TemperatureField field;
    field.facets = surfaces.size();
    field.instant = {prepared.scene.time.start};
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        const std::string& name =
            prepared.world.objects[static_cast<std::size_t>(surfaces.object[f])];
        field.kelvin.push_back(static_cast<float>(name == "warm plate"   ? warm
                                                  : name == "cold plate" ? cold
                                                                         : plain));
    }
    return field;
}

}  // namespace

TEST_CASE("contrast of black plates is that of their temperatures", "[scenes][contrast]") {
    const ScratchFolder folder("contrast");
    lay(folder, plates(R"(
[[contrast]]
targets = ["warm plate", "cold plate"]
observers = ["drone", "aside"]
threshold_K = 5.0
ranges_m = [100.0, 5000.0]
)"));
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Stages stages(prepared);
    const TemperatureField field = of_plates(prepared);
    Progress silent(ProgressStyle::silent);
    const ContrastInput& input = prepared.scene.contrasts.front();
    const ContrastReport report = contrast_of(stages, input, field, silent);
    const std::size_t frames = prepared.sequences[0].frame.size();
    REQUIRE(report.row.size() == 2 * 2 * frames * 2);
    CHECK(report.hidden == 2 * frames * 2);  // the one aside sees sky alone
    // 12 m x 9 m before 96 pixels over 2 tan 30 deg * 60 m.
    const double pixel = 2.0 * std::tan(30.0 * 3.14159265358979 / 180.0) * 60.0 / 96.0;
    for (const ContrastRow& row : report.row) {
        if (row.observer == 1) {
            CHECK(std::isnan(row.rss));
            continue;
        }
        CAPTURE(row.target, row.band);
        const double own = row.target == 0 ? warm : cold;
        CHECK(row.pixels == Approx(12.0 * 9.0 / (pixel * pixel)).epsilon(0.01));
        CHECK(row.range == Approx(60.0).epsilon(0.01));
        // The other plate lies within the ring, and is no background.
        CHECK(row.difference == Approx(own - plain).epsilon(0.01));
        CHECK(row.spread < 0.01);
        CHECK(row.background_entropy < 0.4);
        const Band band = parse_band(row.band, bin_edges_um());
        const double weber = band_radiance(band, own) / band_radiance(band, plain) - 1.0;
        CHECK(row.weber == Approx(weber).epsilon(0.01));
        CHECK(row.edge > 3.0 * row.background_edge);
    }
    REQUIRE(report.summary.size() == 8);
    for (const ContrastSummary& one : report.summary) {
        if (one.observer == 1) {
            CHECK(one.highest == report.row.size());
            continue;
        }
        const bool hot = one.target == 0;
        CHECK(report.row[one.highest].rss ==
              Approx(hot ? warm - plain : plain - cold).epsilon(0.01));
        CHECK(report.row[one.lowest].rss <= report.row[one.highest].rss);
        CHECK(one.sampling_change < 0.05);
        CHECK(one.share == (hot ? 1.0 : 0.0));
        // Nothing is lost in a vacuum.
        REQUIRE(one.at_range.size() == 2);
        CHECK(one.at_range[1] == Approx(one.at_range[0]).epsilon(1e-6));
    }
    const auto json = nlohmann::json::parse(contrast_json(input, report, prepared.scene, {}));
    const auto& first = json["targets"][0];
    CHECK(first["observer"] == "drone");
    CHECK(first["highest"]["sampling_change_K"] < 0.05);
    CHECK(first["lowest"]["rss_K"] <= first["highest"]["rss_K"]);
    CHECK_FALSE(json["targets"][1].contains("highest"));  // the observer aside
    // Cells of 34 x 34 pixels tile a picture of 96 x 64 twice, and the warm plate lies in both.
    CHECK(first["highest"]["clutter_K"].is_null());
    const std::string why = first["highest"]["why"]["clutter_K"];
    CHECK(why.find("twice the target's size") != std::string::npos);
    CHECK(why.find("horizontal_fov_deg") != std::string::npos);
    CHECK(
        contrast_csv(input, report, prepared.scene).find("warm plate,drone,2026-07-15T00:00:00") !=
        std::string::npos);
}

TEST_CASE("a target that mirrors, and one under a net, covers what it covers",
          "[scenes][contrast]") {
    // Rays that meet mirrors and nets are followed apart: what a pixel sees first is the target all
    // the same, for contrast and for the close pictures of signature and detection.
    const std::string finish = GENERATE("finish = { kind = \"metal\", roughness = 0.02 }",
                                        "cover = 0.5\nback = { kind = \"exposed\", emissivity = "
                                        "0.9, albedo = 0.1 }");
    const ScratchFolder folder("contrast_shiny");
    std::string text = plates("\n[material.shiny]\nlike = \"aluminium\"\n" + finish + R"(
[[object]]
name = "sheet"
mesh = "sheet.obj"
up = "z"
place_m = [0.0, 10.0]
height_above_ground_m = 0.5
material = "shiny"
[[contrast]]
targets = ["sheet"]
observers = ["drone"]
bands = ["8-12"]
)");
    text = with(text, "frame_every_s = 21600.0", "frames = [\"2026-07-15T04:00:00-04:00\"]");
    write_text(folder.path / "sheet.obj",
               "v -4 -3 0\nv 4 -3 0\nv 4 3 0\nv -4 3 0\nf 1 2 3\nf 1 3 4\n");
    lay(folder, text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Stages stages(prepared);
    Progress silent(ProgressStyle::silent);
    const ContrastReport report =
        contrast_of(stages, prepared.scene.contrasts.front(), of_plates(prepared), silent);
    REQUIRE(report.row.size() == 1);
    const double pixel = 2.0 * std::tan(30.0 * 3.14159265358979 / 180.0) * 59.5 / 96.0;
    CHECK(report.row[0].pixels == Approx(8.0 * 6.0 / (pixel * pixel)).epsilon(0.01));
    CHECK(report.row[0].range == Approx(59.5).epsilon(0.02));
}

TEST_CASE("contrast at another range is that of the same bodies behind the air there",
          "[scenes][contrast][by_reciprocity]") {
    // Apparent temperatures of black bodies of 310 and 294 K, summed wavelength by wavelength
    // behind 100 m of air, lead to those behind 500 m to 5 km.
    const Atmosphere air = BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const double target = 310.0, behind = 294.0, spread = 0.5;
    for (const char* const name : {"3-5", "8-12"}) {
        const Band band = parse_band(name, bin_edges_um());
        const auto seen = [&](double range, double kelvin) {
            const PathSpectrum path =
                path_at_nodes(air, line_to_target(35.0, 0.0, range), band.node_um);
            double sum = 0.0;
            for (std::size_t i = 0; i < band.node_um.size(); ++i) {
                sum += band.weight[i] *
                       (path.transmittance[i] * planck(band.node_um[i], kelvin) + path.radiance[i]);
            }
            return brightness_temperature(band, sum);
        };
        const SeenContrast near{
            .range = 100.0,
            .target = seen(100.0, target),
            .background = seen(100.0, behind),
            .spread = seen(100.0, target + 0.5 * spread) - seen(100.0, target - 0.5 * spread)};
        const ContrastOnLine at(air, band, {.target_height = 35.0}, near);
        const ContrastOverRange over(at, near, 8000.0);
        const double rss = std::hypot(near.target - near.background, near.spread);
        CHECK(at(100.0) == Approx(rss).epsilon(1e-9));
        CHECK(over(100.0) == Approx(rss).epsilon(1e-9));
        for (const double range : {500.0, 2000.0, 5000.0}) {
            CAPTURE(name, range);
            const double expected =
                std::hypot(seen(range, target) - seen(range, behind),
                           seen(range, target + 0.5 * spread) - seen(range, target - 0.5 * spread));
            CHECK(at(range) == Approx(expected).epsilon(1e-4));
            CHECK(over(range) == Approx(expected).epsilon(2e-3));
        }
    }
}

TEST_CASE("contrast tables are checked, with their place", "[scenes][contrast]") {
    const ScratchFolder folder("contrast_mistakes");
    const auto one = [&](const std::string& keys, const std::string& reported) {
        lay(folder, plates("\n[[contrast]]\n" + keys));
        try {
            read_scene(folder.path / "scene.toml");
            FAIL("accepted: " << keys);
        } catch (const InputError& error) {
            REQUIRE(error.mistakes().size() == 1);
            INFO(error.mistakes()[0].line());
            CHECK(error.mistakes()[0].line().find(reported) != std::string::npos);
        }
    };
    one("", "targets: missing");
    one("targets = [\"warm plat\"]\n", "warm plate");
    one("targets = [\"warm plate\", \"warm plate\"]\n", "twice");
    one("targets = [\"warm plate\"]\nobservers = [\"dron\"]\n", "drone");
    one("targets = [\"warm plate\"]\nbands = [\"0.5-0.6\"]\n", "below 3 um");
    one("targets = [\"warm plate\"]\nranges_m = [0.0]\n", "ranges_m");
}
