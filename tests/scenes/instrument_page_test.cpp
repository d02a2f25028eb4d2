#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "render/instrument/presets.hpp"

using namespace diurna;

// The table of docs/reference/instruments.md has the numbers of the presets. To write it again:
//
//     DIURNA_WRITE_PAGES=1 build/release/scenes_tests "the page of instruments*"

namespace {

constexpr const char* begins = "<!-- presets -->\n";
constexpr const char* ends = "<!-- end of presets -->\n";

std::string number(double value, double per_unit = 1.0) {
    return fmt::format("{:.6g}", per_unit * value);
}

/// One number, or the largest of a curve and where.
std::string of_curve(const Spectrum& curve) {
    const auto most = std::max_element(curve.value.begin(), curve.value.end());
    const auto least = std::min_element(curve.value.begin(), curve.value.end());
    if (*most == *least) return number(*most);
    return fmt::format("curve, {:g} at {:g} µm", *most,
                       curve.wavelength_um[std::size_t(most - curve.value.begin())]);
}

const char* word_of(DetectorKind kind) {
    return kind == DetectorKind::photon ? "photon" : "bolometer";
}

const char* word_of(CorrectionKind kind) {
    return kind == CorrectionKind::none        ? "none"
           : kind == CorrectionKind::one_point ? "one_point"
                                               : "two_point";
}

const char* word_of(Display display) {
    return display == Display::linear    ? "linear"
           : display == Display::plateau ? "plateau"
                                         : "manual";
}

bool photon(const Instrument& c) { return c.detector.kind == DetectorKind::photon; }

struct Row {
    const char *key, *says;
    std::function<std::string(const Instrument&)> value;  // "": the key does not apply
};

std::vector<Row> rows() {
    using I = const Instrument&;
    const auto of_photons = [](auto value) {
        return [value](I c) { return photon(c) ? value(c) : std::string(); };
    };
    const auto if_corrected = [](auto value) {
        return [value](I c) {
            return c.correction.kind == CorrectionKind::none ? std::string() : value(c);
        };
    };
    return {
        {"optics.f_number", "", [](I c) { return number(c.lens.f_number); }},
        {"optics.transmission", "", [](I c) { return of_curve(c.lens.transmission); }},
        {"optics.housing_temperature_K", "",
         [](I c) { return number(c.lens.housing_temperature); }},
        {"optics.cold_stop", "", [](I c) { return c.lens.cold_stop ? "true" : "false"; }},
        {"optics.vignetting", "", [](I c) { return number(c.lens.vignetting); }},
        {"optics.k1", "", [](I c) { return number(c.lens.k1); }},
        {"optics.veiling_glare", "", [](I c) { return number(c.lens.veiling_glare); }},
        {"optics.narcissus", "", [](I c) { return number(c.lens.narcissus); }},
        {"blur.wavefront_error", "waves rms", [](I c) { return number(c.blur.wavefront_error); }},
        {"blur.diffusion_length_um", "", [](I c) { return number(c.blur.diffusion_length, 1e6); }},
        {"detector.kind", "", [](I c) { return word_of(c.detector.kind); }},
        {"detector.pixel_pitch_um", "", [](I c) { return number(c.detector.pitch, 1e6); }},
        {"detector.fill", "", [](I c) { return number(c.detector.fill); }},
        {"detector.efficiency", "", [](I c) { return of_curve(c.detector.efficiency); }},
        {"detector.temperature_K", "", [](I c) { return number(c.detector.temperature); }},
        {"detector.integration_time_ms", "",
         of_photons([](I c) { return number(c.detector.integration_time, 1e3); })},
        {"detector.well_share", "", of_photons([](I c) { return number(c.detector.well_share); })},
        {"detector.well", "electrons", of_photons([](I c) { return number(c.detector.well); })},
        {"detector.dark_current", "electrons/s",
         of_photons([](I c) { return number(c.detector.dark_current); })},
        {"detector.nonlinearity", "",
         of_photons([](I c) { return number(c.detector.nonlinearity); })},
        {"detector.time_constant_ms", "",
         [](I c) { return photon(c) ? std::string() : number(c.detector.time_constant, 1e3); }},
        {"detector.netd_mK", "at 300 K",
         [](I c) { return c.detector.netd > 0.0 ? number(c.detector.netd, 1e3) : std::string(); }},
        {"detector.read_noise", "electrons; mK for a bolometer",
         [](I c) { return c.detector.netd > 0.0 ? std::string() : number(c.detector.read_noise); }},
        {"detector.row_noise", "as read_noise", [](I c) { return number(c.detector.row_noise); }},
        {"detector.column_noise", "as read_noise",
         [](I c) { return number(c.detector.column_noise); }},
        {"detector.flicker_noise", "as read_noise",
         [](I c) { return number(c.detector.flicker_noise); }},
        {"detector.gain_spread", "", [](I c) { return number(c.detector.gain_spread); }},
        {"detector.offset_spread", "as read_noise",
         [](I c) { return number(c.detector.offset_spread); }},
        {"detector.row_offset", "as read_noise", [](I c) { return number(c.detector.row_offset); }},
        {"detector.column_offset", "as read_noise",
         [](I c) { return number(c.detector.column_offset); }},
        {"detector.gain_drift", "per hour",
         if_corrected([](I c) { return number(c.detector.gain_drift); })},
        {"detector.offset_drift", "as read_noise, per hour",
         if_corrected([](I c) { return number(c.detector.offset_drift); })},
        {"detector.dead", "", [](I c) { return number(c.detector.dead); }},
        {"detector.blinking", "", [](I c) { return number(c.detector.blinking); }},
        {"detector.blink", "as read_noise",
         [](I c) { return c.detector.blinking > 0.0 ? number(c.detector.blink) : std::string(); }},
        {"correction.kind", "", [](I c) { return word_of(c.correction.kind); }},
        {"correction.temperatures_K", "", if_corrected([](I c) {
             return c.correction.temperature[0] > 0.0
                        ? fmt::format("{:g}, {:g}", c.correction.temperature[0],
                                      c.correction.temperature[1])
                        : std::string();
         })},
        {"correction.well_shares", "", if_corrected([](I c) {
             return c.correction.temperature[0] > 0.0
                        ? std::string()
                        : fmt::format("{:g}, {:g}", c.correction.well[0], c.correction.well[1]);
         })},
        {"correction.interval_min", "",
         if_corrected([](I c) { return number(c.correction.interval, 1.0 / 60.0); })},
        {"electronics.bits", "", [](I c) { return number(c.electronics.bits); }},
        {"electronics.black_level", "counts",
         [](I c) { return number(c.electronics.black_level); }},
        {"electronics.range_K", "",
         [](I c) {
             return photon(c)
                        ? std::string()
                        : fmt::format("{:g}, {:g}", c.electronics.range[0], c.electronics.range[1]);
         }},
        {"electronics.frame_rate_Hz", "", [](I c) { return number(c.electronics.frame_rate); }},
        {"electronics.display", "", [](I c) { return word_of(c.electronics.display); }},
    };
}

std::string table() {
    std::string text = "| key |", rule = "|---|";
    const std::vector<std::string> names = preset_names();
    for (const std::string& name : names) {
        text += fmt::format(" `{}` |", name);
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const Row& row : rows()) {
        text += fmt::format("| `{}`{}{} |", row.key, *row.says != 0 ? " " : "", row.says);
        for (const std::string& name : names) {
            const std::string value = row.value(preset(name));
            text += fmt::format(" {} |", value.empty() ? "–" : value);
        }
        text += "\n";
    }
    return text;
}

}  // namespace

TEST_CASE("the page of instruments has the presets' numbers", "[scenes][instrument]") {
    const std::filesystem::path file =
        std::filesystem::path(DIURNA_SOURCE_DIR) / "docs/reference/instruments.md";
    std::string page = read_text(file);
    const auto begin = page.find(begins), end = page.find(ends);
    REQUIRE(begin != std::string::npos);
    REQUIRE(end != std::string::npos);
    const std::size_t from = begin + std::string(begins).size();
    if (std::getenv("DIURNA_WRITE_PAGES")) {
        std::ofstream(file, std::ios::binary) << page.substr(0, from) + table() + page.substr(end);
        page = read_text(file);
    }
    CHECK(page.substr(from, page.find(ends) - from) == table());
}
