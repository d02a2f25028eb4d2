#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/instrument_cost.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

// An instrument of a scene, from its keys to its files.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

const std::string mwir = R"([[instrument]]
observer = "east"
band = "3-5"
preset = "cooled_mwir"
optics = { veiling_glare = 0.0 }
)";
const std::string lwir = R"([[instrument]]
name = "bolometer"
observer = "east"
band = "8-12"
preset = "uncooled_lwir"
optics = { veiling_glare = 0.0 }
detector = { offset_drift = 0.0, gain_drift = 0.0 }
electronics = { display = "linear" }
)";

Scene read(const ScratchFolder& folder, const std::string& text) {
    write_text(folder.path / "scene.toml", text);
    return read_scene(folder.path / "scene.toml");
}

std::string mistakes_of(const std::string& text) {
    const ScratchFolder folder("instrument_mistakes");
    try {
        read(folder, text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const std::string east_0400 = "instrument/east_8-12_20260715T040000Z";

double rms(const std::vector<float>& a, const std::vector<float>& b, double& mean) {
    double squares = 0.0, sum = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) {
        sum += double(a[p]) - double(b[p]);
        squares += std::pow(double(a[p]) - double(b[p]), 2);
    }
    mean = sum / double(a.size());
    return std::sqrt(squares / double(a.size()) - mean * mean);
}

}  // namespace

TEST_CASE("a scene's instruments measure what is seen", "[scenes][instrument]") {
    const ScratchFolder folder("instruments");
    const Scene scene = read(folder, small_scene() + mwir + lwir);
    REQUIRE(scene.instruments.size() == 2);
    CHECK(scene.instruments[1].instrument.name == "bolometer");
    CHECK(scene.instruments[1].instrument.detector.kind == DetectorKind::bolometer);
    const fs::path out = folder.path / "out";
    const JobReport report = run_job(scene, {.out = out, .settings = {}});

    // Every file is there and listed.
    for (const char* file : {".exr", ".png", "_display.png"}) {
        CHECK(fs::exists(out / (east_0400 + file)));
        CHECK(std::count(report.files.begin(), report.files.end(), east_0400 + file) == 1);
    }
    const std::string manifest = read_text(out / "manifest.json");
    CHECK(manifest.find(east_0400 + "_display.png") != std::string::npos);
    const std::string curve = read_text(out / "instrument/east_8-12_calibration.csv");
    CHECK(curve.rfind("temperature_K,radiance_W_m2_sr,signal_pW,counts,counts_per_K,netd_mK\n",
                      0) == 0);
    CHECK(read_text(out / "report.html", 1u << 28).find("display of bolometer") !=
          std::string::npos);
    CHECK(read_text(out / "annotations.json", 1u << 28).find(east_0400 + ".png") !=
          std::string::npos);

    // What it measures is what there is: noise is 45 mK and the pattern's correction leaves nothing
    // here, so that the mean is the scene's and what differs is blur at edges.
    for (const std::string band : {"3-5", "8-12"}) {
        const Frame frame = read_exr(out / ("instrument/east_" + band + "_20260715T040000Z.exr"));
        CAPTURE(band);
        const auto& measured = frame["measured_temperature." + band].pixel;
        const auto& seen = frame["apparent_temperature." + band].pixel;
        double mean = 0.0;
        const double off = rms(measured, seen, mean);
        CAPTURE(mean, off);
        CHECK(std::abs(mean) < 0.1);
        CHECK(off > 0.01);
        CHECK(off < 1.5);
        CHECK(frame.attributes.at("instrument.bits") == "14");
        CHECK(frame.notes.at("instrument").find("are aliased") != std::string::npos);
        // Counts are those of the calibration: linear in the signal.
        const double zero = std::stod(frame.attributes.at("instrument.count_zero"));
        const double slope = std::stod(frame.attributes.at("instrument.counts_per_signal"));
        for (std::size_t p = 0; p < seen.size(); p += 101) {
            REQUIRE(double(frame["counts." + band].pixel[p]) ==
                    Approx(zero + slope * double(frame["measured." + band].pixel[p])).margin(0.51));
        }
    }

    // The report says how often radiance was sampled, and what was skipped.
    const auto reported = [&](const std::string& words) {
        return std::any_of(report.notes.begin(), report.notes.end(),
                           [&](const auto& note) { return note.find(words) != std::string::npos; });
    };
    CHECK(reported("radiance samples per pixel and axis"));
    CHECK(reported("effects without settings, not modelled: "));
    CHECK(reported("NETD at 300 K 45 mK"));
    CHECK_FALSE(reported("the same noise"));
}

TEST_CASE("an instrument's frame alone is its frame in the sequence", "[scenes][instrument]") {
    const ScratchFolder folder("instrument_alone");
    const auto counts = [&](std::vector<std::string> only, const std::string& name, int threads) {
        set_thread_count(threads);
        run_job(read(folder, small_scene() + mwir),
                {.out = folder.path / name, .settings = {}, .pictures = {.only = std::move(only)}});
        set_thread_count(0);
        return read_text(folder.path / name / "instrument/east_3-5_20260715T160000Z.png");
    };
    const std::string in_sequence = counts({}, "all", 2);
    CHECK(counts({"frames=12:00..12:00"}, "one", 1) == in_sequence);
}

TEST_CASE("one table [instrument] is sufficient, errors in it are reported in a line",
          "[scenes][instrument]") {
    const std::string one = with(small_scene(), "bands = [\"3-5\", \"8-12\"]", "bands = [\"3-5\"]");
    CHECK(mistakes_of(one + "[instrument]\npreset = \"cooled_mwir\"\n").empty());
    const std::vector<std::array<std::string, 2>> wrong = {
        {"[instrument]\npreset = \"cooled\"\n", "preset"},
        {"[instrument]\nobserver = \"west\"\n", "unknown observer \"west\""},
        {"[instrument]\nband = \"8-12\"\n", "unknown band \"8-12\""},
        {"[instrument]\noptics = { f_numbr = 2.0 }\n", "did you mean 'f_number'?"},
        {"[instrument]\noptics = { transmission_curve = [[8.0, 0.9], [12.0, 0.9]] }\n",
         "no light of the band 3-5"},
        {"[instrument]\nblur = { turbulence_cn2 = 1e-14 }\n", "turbulence_range_m"},
        {"[instrument]\ndetector = { netd_mK = 20.0, read_noise = 3.0 }\n",
         "cannot be combined with"},
        {"[instrument]\nelectronics = { bits = 20 }\n", "8 to 16"},
        {"[instrument]\nelectronics = { display = \"manual\" }\n", "level"},
        {"[instrument]\ndetector = { time_constant_ms = 8.0 }\n", "time_constant_ms"},
        {"[instrument]\ncorrection = { kind = \"none\", interval_min = 3.0 }\n", "has no effect"},
        {"[instrument]\ncorrection = { kind = \"none\" }\ndetector = { gain_drift = 0.1 }\n",
         "there is no correction"},
        {"[instrument]\noptics = { narcissus = 0.0, narcissus_radius = 1.0 }\n", "has no effect"},
        {"[[instrument]]\n[[instrument]]\nname = \"b\"\n", "a second instrument of \"east\""},
    };
    for (const auto& [text, expected] : wrong) {
        CAPTURE(text);
        const std::string reported = mistakes_of(one + text);
        CAPTURE(reported);
        CHECK(reported.find(expected) != std::string::npos);
        CHECK(reported.find("scene.toml:") != std::string::npos);
    }
    CHECK(mistakes_of(small_scene() + "[instrument]\n").find("expected one of its observer's") !=
          std::string::npos);
    CHECK(mistakes_of(with(one, "horizontal_fov_deg = 24.0",
                           "horizontal_fov_deg = 24.0\nprojection = \"equidistant\"") +
                      "[instrument]\n")
              .find("pinhole") != std::string::npos);
}

TEST_CASE("settings that contradict each other are refused before anything is computed",
          "[scenes][instrument]") {
    const ScratchFolder folder("instrument_contradiction");
    const auto reported = [&](const std::string& text) -> std::string {
        try {
            prepare(read(folder, text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::string start =
        small_scene() + "[[instrument]]\nobserver = \"east\"\nband = \"3-5\"\n";
    const std::string quiet = reported(start + "detector = { netd_mK = 1.0 }\n");
    CHECK(quiet.find("scene.toml:") != std::string::npos);
    CHECK(quiet.find("a NETD of 1 mK is less than") != std::string::npos);
    CHECK(quiet.find("raise detector.netd_mK, lower optics.f_number") != std::string::npos);
    CHECK(reported(start + "optics = { k1 = -40.0 }\n").find("is not unique") != std::string::npos);
    const std::string bright =
        with(small_scene(), "bands = [\"3-5\", \"8-12\"]", "bands = [\"0.4-0.7\"]") +
        "[instrument]\npreset = \"visible\"\n";
    CHECK(reported(bright).empty());
    CHECK(reported(bright +
                   "correction = { kind = \"two_point\", temperatures_K = [290.0, 310.0] }\n")
              .find("cannot be corrected") != std::string::npos);
}

TEST_CASE("a bolometer continues from the picture before", "[scenes][instrument]") {
    const ScratchFolder folder("instrument_lag");
    const std::string text =
        with(small_scene(), "frame_every_s = 21600.0",
             "frames = [\"2026-07-15T12:00:00-04:00\", \"2026-07-15T12:00:01-04:00\"]") +
        with(lwir, "offset_drift", "time_constant_ms = 300.0, offset_drift");
    const JobReport report =
        run_job(read(folder, text), {.out = folder.path / "out", .settings = {}});
    CHECK(std::any_of(report.notes.begin(), report.notes.end(), [](const auto& note) {
        return note.find("1 of 2 pictures follow") != std::string::npos;
    }));
    // What stands still is seen as it is.
    const Frame first = read_exr(folder.path / "out/instrument/east_8-12_20260715T160000Z.exr");
    const Frame second = read_exr(folder.path / "out/instrument/east_8-12_20260715T160001Z.exr");
    double mean = 0.0;
    rms(first["signal.8-12"].pixel, second["signal.8-12"].pixel, mean);
    CHECK(std::abs(mean) < 1e-3 * double(first["signal.8-12"].pixel[0]));
}

TEST_CASE("a plan lists what an instrument costs and omits", "[scenes][instrument]") {
    const ScratchFolder folder("instrument_plan");
    const Prepared without = prepare(read(folder, small_scene()));
    const Scene scene = read(folder, small_scene() + mwir);
    const InstrumentCost cost = instrument_cost(scene, scene.instruments.front());
    const Prepared with_one = prepare(scene);
    const double rays = double(with_one.plan.view_rays) - double(without.plan.view_rays);
    CHECK(rays == cost.seen_pixels * cost.samples);
    CHECK(rays >= 64.0 * 48.0 * 16.0);  // no fewer than the observer's own
    CHECK(with_one.plan.seconds > without.plan.seconds);
    const std::string text = describe(with_one.plan);
    CHECK(text.find("radiance samples per pixel and axis") != std::string::npos);
    CHECK(text.find("stages of instrument cooled_mwir") != std::string::npos);
}
