#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/black_band.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// The figure of text books: radiant temperatures of surfaces through a day (Sabins 1987, Remote
// Sensing: Principles and Interpretation, chapter 5; Lillesand & Kiefer, Remote Sensing and Image
// Interpretation, chapter 5.7). What they say in words is asked of the scene's pictures, and closed
// forms of what lies behind it.

namespace {

constexpr double half_hour = 1800.0, day_frequency = 2.0 * std::numbers::pi / 86400.0;
constexpr double hour = 3600.0;

/// Seconds after midnight of the scene's clock of sunrise and sunset: cos H = (sin(−0.833°) − sin φ
/// sin δ) / (cos φ cos δ) (NOAA), declination 21.5° and equation of time −5.9 min of 15 July.
struct SunTimes {
    double rise, noon, set;
};
SunTimes sun_times() {
    constexpr double degree = std::numbers::pi / 180.0, latitude = 36.32, longitude = -84.2033;
    constexpr double declination = 21.5, equation = -5.9 * 60.0, clock = -4.0 * 3600.0;
    const double noon = 43200.0 - longitude * 240.0 - equation + clock;
    const double cosine =
        (std::sin(-0.833 * degree) - std::sin(latitude * degree) * std::sin(declination * degree)) /
        (std::cos(latitude * degree) * std::cos(declination * degree));
    const double half = std::acos(cosine) / day_frequency;
    return {noon - half, noon, noon + half};
}

/// The median of a plane over the pixels where `among` has this value, those at its rim skipped.
double middle(const Frame& frame, const std::string& plane, const std::string& among, float value) {
    const std::vector<float>& key = frame[among].pixel;
    std::vector<float> found;
    for (int row = 1; row + 1 < frame.height; ++row) {
        for (int column = 1; column + 1 < frame.width; ++column) {
            const auto p = std::size_t(row * frame.width + column);
            const auto w = std::size_t(frame.width);
            const bool inside = key[p] == value && key[p - 1] == value && key[p + 1] == value &&
                                key[p - w] == value && key[p + w] == value;
            if (inside) found.push_back(frame[plane].pixel[p]);
        }
    }
    REQUIRE(!found.empty());
    std::nth_element(found.begin(), found.begin() + long(found.size() / 2), found.end());
    return found[found.size() / 2];
}

/// Heat of the whole day, and pictures of it, made once.
struct Day {
    ScratchFolder folder{"crossover"};
    Prepared prepared = prepare(scene());
    Stages stages{prepared};
    SpanResult heat;
    std::map<std::string, std::vector<double>> apparent;  // (frame) [K] 8-12, by name of the plate

    /// With the drone alone, in one band.
    static Scene scene() {
        Scene scene = read_scene(DIURNA_SOURCE_DIR "/scenes/crossover/scene.toml");
        scene.observers.resize(1);
        scene.observers[0].bands = {"8-12"};
        scene.time.every_step = true;  // harmonics of half-hours would alias
        return scene;
    }
    Day() {
        Progress progress(ProgressStyle::silent);
        heat = solve_scene(stages, progress);
        std::filesystem::create_directories(folder.path / "frames");
        render_frames(stages, heat.temperature, folder.path, progress);
        std::map<std::string, float> plate;
        const std::vector<std::string>& objects = prepared.world.objects;
        for (std::size_t o = 0; o < objects.size(); ++o) plate[objects[o]] = float(o);
        for (const Instant instant : prepared.plan.frames) {
            const Frame frame =
                read_exr(folder.path / (frame_base("drone", "8-12", instant) + ".exr"));
            for (const auto& [name, object] : plate) {
                if (object == 0.0f) continue;
                apparent[name].push_back(
                    middle(frame, "apparent_temperature.8-12", "object", object));
            }
        }
    }
    /// A harmonic of the day of what a facet has.
    std::complex<double> harmonic(const std::vector<float>& values, std::size_t facet,
                                  int order) const {
        std::complex<double> sum = 0.0;
        const std::vector<Instant>& when = heat.temperature.instant;
        const auto count = std::size_t(86400.0 / seconds_between(when[0], when[1]) + 0.5);
        for (std::size_t i = 0; i < count; ++i) {
            const double phase = 2.0 * std::numbers::pi * double(i) * order / double(count);
            sum += double{values[i * heat.temperature.facets + facet]} *
                   std::polar(2.0 / double(count), -phase);
        }
        return sum;
    }
    std::size_t facet_at(const Eigen::Vector3d& place) const {
        const FacetSet& facets = prepared.world.surfaces();
        std::size_t best = 0;
        double nearest = 1e30;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const double far = (facets.centroid[f].cast<double>() - place).norm();
            if (far < nearest) {
                nearest = far;
                best = f;
            }
        }
        return best;
    }
    double range(const std::string& name) const {
        const auto& curve = apparent.at(name);
        return *std::max_element(curve.begin(), curve.end()) -
               *std::min_element(curve.begin(), curve.end());
    }
    /// [s] of the day at which one curve passes another, straight between pictures.
    std::vector<double> crossings(const std::string& a, const std::string& b) const {
        std::vector<double> found;
        for (std::size_t i = 0; i + 1 < apparent.at(a).size(); ++i) {
            const double before = apparent.at(a)[i] - apparent.at(b)[i];
            const double after = apparent.at(a)[i + 1] - apparent.at(b)[i + 1];
            if ((before < 0.0) == (after < 0.0)) continue;
            found.push_back(half_hour * (double(i) + before / (before - after)));
        }
        return found;
    }
};
const Day& day() {
    static const Day once;
    return once;
}

void check_crossings() {
    const SunTimes sun = sun_times();
    for (const char* name : {"soil plate", "sand plate"}) {
        const std::vector<double> crossed = day().crossings(name, "pond");
        CAPTURE(name, crossed, sun.rise, sun.set);
        REQUIRE(crossed.size() == 2);
        CHECK(crossed[0] - sun.rise > 0.5 * hour);
        CHECK(crossed[0] - sun.rise < 3.0 * hour);
        CHECK(std::abs(crossed[1] - sun.set) < 1.0 * hour);
    }
    // Painted metal cools below grass by night and warms above it by day.
    const std::vector<double> sheet = day().crossings("painted sheet", "meadow");
    REQUIRE(sheet.size() == 2);
    CHECK(std::abs(sheet[0] - sun.rise) < 1.5 * hour);
    CHECK(std::abs(sheet[1] - sun.set) < 1.0 * hour);
}

void check_order() {
    const auto& curves = day().apparent;
    const SunTimes sun = sun_times();
    for (std::size_t i = 0; i < curves.at("pond").size(); ++i) {
        const double when = half_hour * double(i);
        CAPTURE(when / 3600.0);
        // Bare metal looks cold at all hours, for it shows the sky; paved ground stays warmer than
        // meadow by day and by night (which is how streets are found in pictures before dawn).
        for (const auto& [name, curve] : curves) {
            if (name != "bare sheet") CHECK(curves.at("bare sheet")[i] < curve[i] - 10.0);
        }
        CHECK(curves.at("asphalt plate")[i] > curves.at("meadow")[i]);
        CHECK(curves.at("concrete plate")[i] > curves.at("meadow")[i]);
        const bool night = when < sun.rise || when > sun.set + hour;
        const bool noon = std::abs(when - sun.noon) < 3.0 * hour;
        if (night) {
            CHECK(curves.at("pond")[i] > curves.at("soil plate")[i]);
            CHECK(curves.at("soil plate")[i] > curves.at("meadow")[i]);
            CHECK(curves.at("meadow")[i] > curves.at("painted sheet")[i]);
        }
        if (noon) {
            CHECK(curves.at("soil plate")[i] > curves.at("meadow")[i]);
            CHECK(curves.at("meadow")[i] > curves.at("pond")[i]);
        }
    }
    // Soil is warmest one to two hours after the sun's noon, coldest about sunrise; water changes
    // by a few kelvin and is warmest later.
    const auto peak = [&](const std::string& name) {
        const auto& curve = curves.at(name);
        return half_hour * double(std::max_element(curve.begin(), curve.end()) - curve.begin());
    };
    const auto& soil = curves.at("soil plate");
    const double coldest =
        half_hour * double(std::min_element(soil.begin(), soil.end()) - soil.begin());
    CHECK(peak("soil plate") - sun.noon > 0.5 * hour);
    CHECK(peak("soil plate") - sun.noon < 2.0 * hour);
    CHECK(std::abs(coldest - sun.rise) < 0.75 * hour);
    CHECK(day().range("pond") < 4.0);
    CHECK(peak("pond") > peak("soil plate") + hour);
    // The greater the inertia (588, 968 and it dries, 1781), the less of the absorbed sun's range;
    // albedos 0.37, 0.20, 0.09.
    const double sand = day().range("sand plate") / 0.63,
                 asphalt = day().range("asphalt plate") / 0.91;
    CHECK(sand > day().range("soil plate") / 0.80);
    CHECK(sand > 1.3 * asphalt);
    CHECK(asphalt > 5.0 * day().range("pond") / 0.94);
}

void check_inertia() {
    // T / G = coth(q d) / (k q), q² = iω / a (Carslaw & Jaeger 1959, 2.6 and 3.5): dry sand of 0.27
    // W/mK is endless for a day (q d = 4, what follows changes e⁻⁸); a stirred pond of 2 m is not.
    struct Layer {
        double east, north, conductivity, heat_capacity, depth;
    };
    const Layer layer = GENERATE(Layer{15.0, 5.0, 0.27, 1600.0 * 800.0, 0.3},
                                 Layer{-15.0, -5.0, 500.0, 998.0 * 4182.0, 2.0});
    const std::size_t facet = day().facet_at({layer.east, layer.north, 0.0});
    for (const int order : {1, 2}) {
        const std::complex<double> q = std::sqrt(std::complex<double>(
            0.0, order * day_frequency * layer.heat_capacity / layer.conductivity));
        const std::complex<double> expected =
            1.0 / (layer.conductivity * q * std::tanh(q * layer.depth));
        const std::complex<double> found =
            day().harmonic(day().heat.temperature.kelvin, facet, order) /
            day().harmonic(day().heat.heat.of(HeatTerm::conducted), facet, order);
        CAPTURE(layer.east, order, expected, found);
        CHECK(std::abs(found) == Approx(std::abs(expected)).epsilon(0.006));
        CHECK(std::arg(found / expected) == Approx(0.0).margin(0.006));
    }
}

void check_bare_sheet() {
    // L = ε B(T) + (1 − ε) L(zenith), ε = 0.050 in 8-12 um 10° from the normal (ECOSTRESS:
    // weathered aluminium), over the 2.4 m of air between.
    const std::string source = DIURNA_SOURCE_DIR "/scenes/crossover/";
    std::string text = read_text(source + "scene.toml");
    text.erase(text.find("[[observer]]"));
    text = with(text, "\"level.asc\"", "\"" + source + "level.asc\"");
    text = with(text, "../jacksboro", DIURNA_SOURCE_DIR "/scenes/jacksboro");
    for (std::size_t at = 0; (at = text.find("\"plate.obj", at)) != std::string::npos;) {
        text.insert(at + 1, source);
    }
    text = with(text, "frame_every_s = 1800.0",
                "frames = [\"02:00-04:00 every 2 h\", \"22:30-23:00 every 1 h\"]");
    const auto camera = [](const std::string& name, const std::string& place, double elevation) {
        return "[[observer]]\nname = \"" + name + "\"\nplace_m = " + place +
               "\nheight_above_ground_m = 3.0\nazimuth_deg = 0.0\nelevation_deg = " +
               std::to_string(elevation) +
               "\nhorizontal_fov_deg = 10.0\nwidth = 8\nheight = 8\nbands = [\"8-12\"]\n";
    };
    const ScratchFolder folder("sheet");
    write_text(folder.path / "scene.toml",
               text + camera("down", "[5.0, -5.0]", -90.0) + camera("up", "[0.0, 20.0]", 90.0));
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    std::filesystem::create_directories(folder.path / "frames");
    Progress progress(ProgressStyle::silent);
    render_frames(Stages(prepared, day().stages), day().heat.temperature, folder.path, progress);
    for (const Instant instant : prepared.plan.frames) {
        const Frame sheet = read_exr(folder.path / (frame_base("down", "8-12", instant) + ".exr"));
        const Frame sky = read_exr(folder.path / (frame_base("up", "8-12", instant) + ".exr"));
        const std::size_t centre = 4 * 8 + 4;
        const double own = sheet["temperature"].pixel[centre];
        const double zenith = sky["radiance.8-12"].pixel[centre];
        const double expected = 0.050 * testing::black_band(own) + 0.950 * zenith;
        const double found = sheet["apparent_temperature.8-12"].pixel[centre];
        CAPTURE(own, zenith, expected, found);
        CHECK(testing::black_band(found) ==
              Approx(double{sheet["radiance.8-12"].pixel[centre]}).epsilon(1e-4));
        // 1 % of radiance is 0.4 K here.
        CHECK(testing::black_band(found) == Approx(expected).epsilon(0.01));
        CHECK(found < own - 30.0);
    }
}

void check_painted_sheet() {
    // At 4 h: air 291.76 K, vapour 18.2 hPa, so a sky of emissivity 0.83 (Prata 1996, Q. J. R.
    // Meteorol. Soc. 122, 1127); the lower side sees meadow.
    const Day& d = day();
    const auto at = std::size_t(4 * 2);
    const double air = 291.76, w = 46.5 * 18.2 / air;
    const double sky = air * std::pow(1.0 - (1.0 + w) * std::exp(-std::sqrt(1.2 + 3.0 * w)), 0.25);
    const std::size_t sheet = d.facet_at({-5.6, -5.3, 0.6}), meadow = d.facet_at({0.0, 15.0, 0.0});
    const std::vector<float> kelvin =
        d.heat.temperature.interpolate(later(d.prepared.scene.time.start, half_hour * double(at)));
    const double radiating =
        std::pow(0.5 * (std::pow(sky, 4) + std::pow(double{kelvin[meadow]}, 4)), 0.25);
    CAPTURE(sky, radiating, kelvin[sheet]);
    CHECK(kelvin[sheet] < air - 1.0);
    CHECK(kelvin[sheet] > radiating);
}

}  // namespace

// Sections of one case, so that the day is made once.
TEST_CASE("plates in a meadow cross as text books and closed forms say",
          "[scenes][crossover][by_events][by_comparison]") {
    SECTION("soil and sand cross water after dawn and near sunset") { check_crossings(); }
    SECTION("who is warm by day and by night is as the text books say") { check_order(); }
    SECTION("heat that enters sand and water leads their temperature as in closed form") {
        check_inertia();
    }
    SECTION("a bare sheet by night shows its own heat and the sky above") { check_bare_sheet(); }
    SECTION("painted sheet by night is between the air and a body that only radiates") {
        check_painted_sheet();
    }
}
