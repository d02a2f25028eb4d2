#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/radiation/planck.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/world/air.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tape7_text.hpp"

using namespace diurna;

namespace {

std::string scene_text(const std::string& atmosphere) {
    return with(with(small_scene(), "bands = [\"3-5\", \"8-12\"]",
                     "terms = true\nbands = [\"8-12\"]"),
                "frame_every_s = 21600.0", "frame_every_s = 43200.0") +
           "[atmosphere]\n" + atmosphere;
}

/// The air that the tables hold.
const std::string of_summer = "profile = \"MLS\"\n";

std::string problem_of(const std::filesystem::path& folder, const std::string& text) {
    write_text(folder / "scene.toml", text);
    try {
        prepare(read_scene(folder / "scene.toml"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// The small scene through the embedded air, what its lines of sight span, and that as a tape7 and
/// as a convolved one.
struct Pair {
    ScratchFolder folder{"table-scene"};
    Scene plain;
    std::string tape, convolved;

    Pair() {
        // By formulas, as the heat of a scene through a table is.
        write_text(folder.path / "plain.toml", scene_text(of_summer + "drives_heat = false\n"));
        plain = read_scene(folder.path / "plain.toml");
        const Prepared prepared = prepare(plain);
        const double sea = prepared.world.sea_level_height / 1000.0;
        double low = 0.0, high = 0.0;
        for (const Eigen::Vector3f& v : prepared.world.facets.vertex) {
            low = std::min(low, 1e-3 * double{v.z()});
            high = std::max(high, 1e-3 * double{v.z()});
        }
        const double eye = sea + 1e-3 * prepared.sequences[0].at(0).position.z();
        const double top = std::max(eye, sea + high) + 0.01, bottom = sea + low - 0.01;
        std::vector<double> to;
        for (int i = 0; i < 4; ++i) to.push_back(bottom + (top - bottom) * i / 3.0);
        Atmosphere air = atmosphere_at(plain, prepared.world, prepared.weather, plain.time.start);
        const BinRange bins = bins_of(named_band({}, "8-12", bin_edges_um()).node_um);
        for (const AskedPath& path : asked_paths({eye - 0.01, eye + 0.01}, to, 130.0)) {
            const PathSpectrum spectrum = asked_spectrum(std::get<BandModel>(air), path, bins);
            tape += tape7_run(path, spectrum, bins);
            convolved += convolved_run(path, spectrum, bins);
        }
        write_text(folder.path / "air.tp7", tape);
        write_text(folder.path / "air.7sc", convolved);
    }
};

}  // namespace

TEST_CASE("a scene through a table of paths looks as through the air it was made of",
          "[scenes][air][tabulated]") {
    const Pair pair;
    const auto& folder = pair.folder.path;
    write_text(folder / "table.toml", scene_text(of_summer + "table = \"air.tp7\"\n"));
    const auto options = [&](const char* name) {
        JobOptions o;
        o.out = folder / name;
        return o;
    };
    const JobReport plain = run_job(pair.plain, options("plain"));
    const JobReport table = run_job(read_scene(folder / "table.toml"), options("table"));
    write_text(folder / "convolved.toml", scene_text(of_summer + "table = \"air.7sc\"\n"));
    run_job(read_scene(folder / "convolved.toml"), options("convolved"));
    /// Worst difference of a frame's apparent temperatures [K], of what surfaces emit and the air
    /// adds: a table has no amounts of gas to join the sky's way with that to the eye.
    const Band band = named_band({}, "8-12", bin_edges_um());
    const auto worst_of = [&](const std::string& file, const char* through = "table") {
        const Frame a = read_exr(folder / "plain" / file), b = read_exr(folder / through / file);
        const auto kelvins = [&](const Frame& frame, std::size_t i) {
            const double emitted{frame["emitted.8-12"].pixel[i]};
            return brightness_temperature(band, emitted + double{frame["path.8-12"].pixel[i]});
        };
        REQUIRE(b["emitted.8-12"].pixel.size() == 64 * 48);
        double worst = 0.0;
        for (std::size_t i = 0; i < 64 * 48; ++i) {
            worst = std::max(worst, std::abs(kelvins(b, i) - kelvins(a, i)));
        }
        return worst;
    };
    std::vector<std::string> pictures;
    for (const std::string& file : plain.files) {
        if (file.ends_with(".exr")) pictures.push_back(file);
    }
    const double midnight = worst_of(pictures.at(0)), noon = worst_of(pictures.at(1));
    fmt::print("  {}: worst {:.1f} mK; through midnight's air at noon {:.0f} mK\n", pictures.at(0),
               1e3 * midnight, 1e3 * noon);
    CHECK(midnight < 0.005);
    CHECK(worst_of(pictures.at(0), "convolved") < 0.005);
    // The table stays midnight's air.
    CHECK(noon > 0.1);
    bool reported = false;
    for (const std::string& note : table.notes) {
        reported = reported || note.find("air.tp7, the same at every instant") != std::string::npos;
    }
    CHECK(reported);
    CHECK(read_text(folder / "table" / "manifest.json", 1u << 24).find("air.tp7") !=
          std::string::npos);
}

TEST_CASE("what a table of paths cannot give a scene is refused in a line",
          "[scenes][air][tabulated]") {
    const Pair pair;
    const auto& folder = pair.folder.path;
    const auto problem = [&](const std::string& atmosphere, const std::string& from = "",
                             const std::string& to = "") {
        return problem_of(folder, with(scene_text(atmosphere), from, to));
    };
    const std::string table = "table = \"air.tp7\"\n";
    using Catch::Contains;
    CHECK(problem(table).empty());
    CHECK(problem("table = \"air.7sc\"\n").empty());
    CHECK_THAT(problem("table = \"other.tp7\"\n"),
               Contains("scene.toml:49:9: ") && Contains("no such file"));
    CHECK_THAT(problem(table + "drives_heat = true\n"),
               Contains("atmosphere.table: ") && Contains("no fluxes"));
    CHECK_THAT(problem(table + "profile = \"vacuum\"\n"), Contains("a vacuum has no table"));
    CHECK_THAT(problem(table, "\"8-12\"", "\"8-14\""), Contains("band 8-14 needs 8 to 14 um"));
    CHECK_THAT(problem(table, "\"8-12\"", "\"0.7-1.0\""), Contains("no scattered sun"));
    CHECK_THAT(problem(table, "height_above_ground_m = 450.0", "height_above_ground_m = 900.0"),
               Contains("atmosphere.table: observers are at heights from"));

    const auto damaged = [&](const std::string& text) {
        write_text(folder / "bad.tp7", text);
        return problem("table = \"bad.tp7\"\n");
    };
    const std::size_t one = pair.tape.find(" -9999.\n") + 8;
    CHECK_THAT(damaged(pair.tape.substr(0, one)), Contains("0 to space"));
    CHECK_THAT(damaged(pair.tape.substr(0, one - 20)),
               Contains("bad.tp7:") && Contains("scene.toml:"));
    CHECK_THAT(damaged(pair.tape + pair.tape.substr(0, one)), Contains("the same path twice"));
    CHECK_THAT(damaged(""), Contains("empty"));
    // The last run is the sky at 90 degrees of the highest place; then 89.6, 89.
    std::string low = pair.tape;
    for (int k = 0; k < 3; ++k) low.resize(low.rfind(" -9999.\n", low.size() - 9) + 8);
    CHECK_THAT(damaged(low), Contains("at least 89 deg"));
}
