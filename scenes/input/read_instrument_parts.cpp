#include "scenes/input/read_instrument_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "materials/base/error.hpp"
#include "render/instrument/presets.hpp"

namespace diurna {

namespace {

/// A number whose default is the preset's; `unit` of the key's over SI.
double number(const Section& section, const char* key, const char* says, double preset, Range range,
              double unit = 1.0) {
    return unit * section.number_or(key, says, {preset / unit, "the preset's"}, range);
}

/// One number for all wavelengths, or a curve as rows of wavelength and value.
Spectrum spectrum(const Section& section, const char* key, const char* curve_key, const char* says,
                  const char* curve_says, const Spectrum& preset) {
    if (section.has(curve_key)) {
        if (section.has(key)) section.mistake(key, fmt::format("stands beside {}", curve_key));
        Spectrum curve;
        bool fits = true;
        for (const std::vector<double>& row : section.rows(curve_key, curve_says, 2, 2)) {
            fits = fits && row[0] >= 0.2 && row[0] <= 100.0 && row[1] >= 0.0 && row[1] <= 1.0 &&
                   (curve.wavelength_um.empty() || row[0] > curve.wavelength_um.back());
            curve.wavelength_um.push_back(row[0]);
            curve.value.push_back(row[1]);
        }
        if (fits && curve.value.size() >= 2) return curve;
        section.mistake(curve_key,
                        "expected wavelengths ascending within 0.2 to 100 µm, and values "
                        "of 0 to 1");
        return preset;
    }
    const double share =
        section.number_or(key, says, {preset.value.front(), "the preset's"}, {0.0, 1.0});
    return section.has(key) ? flat_spectrum(share) : preset;
}

void read_optics(const Section& section, Lens& lens) {
    lens.f_number = number(section, "f_number",
                           "focal length over aperture; the focal length is "
                           "that of the observer's field of view on a detector of this pitch",
                           lens.f_number, {0.5, 100.0});
    lens.transmission = spectrum(
        section, "transmission", "transmission_curve", "of the lens; what lacks, it emits",
        "[[wavelength in µm, transmission], ...] in place of transmission", lens.transmission);
    lens.housing_temperature = number(section, "housing_temperature_K", "of lens and walls",
                                      lens.housing_temperature, {50.0, 500.0});
    lens.cold_stop = section.flag_or(
        "cold_stop", "the detector sees the lens alone; else warm walls beside it, too",
        lens.cold_stop);
    lens.cos4 =
        section.flag_or("cos4", "light falls off with the cosine's fourth power", lens.cos4);
    lens.vignetting = number(section, "vignetting",
                             "share of the light that mounts cut off in the picture's corners",
                             lens.vignetting, {0.0, 1.0});
    lens.k1 = number(section, "k1", "of Brown's distortion, of places over the focal length",
                     lens.k1, {-1e4, 1e4});
    lens.k2 = number(section, "k2", "likewise, of the fourth power", lens.k2, {-1e7, 1e7});
    lens.k3 = number(section, "k3", "likewise, of the sixth", lens.k3, {-1e9, 1e9});
    lens.p1 = number(section, "p1", "likewise, tangential", lens.p1, {-1e3, 1e3});
    lens.p2 = number(section, "p2", "likewise, tangential", lens.p2, {-1e3, 1e3});
    lens.veiling_glare =
        number(section, "veiling_glare", "share of the light that is spread over the picture",
               lens.veiling_glare, {0.0, 1.0});
    lens.narcissus = number(section, "narcissus",
                            "share of the lens that mirrors the cold detector, in the middle",
                            lens.narcissus, {0.0, 1.0});
    if (section.has("narcissus_radius") && lens.narcissus <= 0.0) {
        section.mistake("narcissus_radius", "tells nothing without narcissus");
    }
    if (section.has("narcissus_radius") && lens.narcissus <= 0.0) {
        section.mistake("narcissus_radius", "tells nothing without narcissus");
    }
    lens.narcissus_radius =
        number(section, "narcissus_radius", "of half the diagonal, where it has fallen to 1/e",
               lens.narcissus_radius, {0.01, 10.0});
}

void read_blur(const Section& section, Blur& blur) {
    blur.diffraction =
        section.flag_or("diffraction", "of the round lens, over the band", blur.diffraction);
    blur.wavefront_error = number(section, "wavefront_error", "rms of the lens' errors, in waves",
                                  blur.wavefront_error, {0.0, 0.18});
    blur.defocus = number(section, "defocus_um", "of the detector from the focus", blur.defocus,
                          {-1000.0, 1000.0}, 1e-6);
    blur.diffusion_length =
        number(section, "diffusion_length_um", "of charge in the detector, as exp(-x/length)",
               blur.diffusion_length, {0.0, 1000.0}, 1e-6);
    blur.jitter = number(section, "jitter_mrad", "rms of the line of sight, each way", blur.jitter,
                         {0.0, 100.0}, 1e-3);
    const std::vector<double> drift = section.numbers_or(
        "drift_mrad", "[right, down] of the line of sight while the detector looks",
        {std::vector{1e3 * blur.drift.x(), 1e3 * blur.drift.y()}, "the preset's"}, 2);
    if (drift.size() == 2) blur.drift = {1e-3 * drift[0], 1e-3 * drift[1]};
    blur.turbulence_cn2 =
        number(section, "turbulence_cn2", "of the air's index, in m^(-2/3): 1e-16 to 1e-12",
               blur.turbulence_cn2, {0.0, 1e-8});
    blur.turbulence_range = number(section, "turbulence_range_m",
                                   "with turbulence_cn2: to what is looked at; one for all pixels",
                                   blur.turbulence_range, {0.0, 1e6});
    if (blur.turbulence_cn2 > 0.0 && blur.turbulence_range <= 0.0) {
        section.mistake("turbulence_range_m", "missing beside turbulence_cn2");
    }
    if (section.has("turbulence_range_m") && blur.turbulence_cn2 <= 0.0) {
        section.mistake("turbulence_range_m", "tells nothing without turbulence_cn2");
    }
    if (section.has("turbulence_range_m") && blur.turbulence_cn2 <= 0.0) {
        section.mistake("turbulence_range_m", "tells nothing without turbulence_cn2");
    }
    if (!blur.diffraction && (blur.defocus != 0.0 || section.has("wavefront_error"))) {
        section.mistake("diffraction", "is false, but a lens' errors need the whole of its MTF");
    }
}

constexpr Range share{0.0, 1.0}, noise{0.0, 1e9};

void read_photons(const Section& section, Detector& detector) {
    detector.integration_time = number(section, "integration_time_ms", "at most",
                                       detector.integration_time, {1e-6, 1e6}, 1e-3);
    detector.well_share = number(section, "well_share",
                                 "of the well, that the brightest per cent of a picture fills at "
                                 "most: shortens integration_time_ms; 0: it stays",
                                 detector.well_share, share);
    detector.well =
        number(section, "well", "electrons that a pixel holds", detector.well, {10.0, 1e12});
    detector.dark_current =
        number(section, "dark_current", "electrons a second", detector.dark_current, {0.0, 1e15});
    detector.capacitance = number(section, "capacitance_fF",
                                  "of a pixel that is reset without double sampling: kTC noise",
                                  detector.capacitance, {0.0, 1e9}, 1e-15);
    detector.shot_noise =
        section.flag_or("shot_noise", "counting of electrons", detector.shot_noise);
    detector.nonlinearity = number(section, "nonlinearity",
                                   "share lacking at a full well; of pixels a tenth apart, rms",
                                   detector.nonlinearity, {0.0, 0.3});
}

void read_noises(const Section& section, Detector& detector) {
    detector.netd = number(section, "netd_mK",
                           "at 300 K, of all temporal noise of a pixel, in place of read_noise",
                           detector.netd, {0.0, 1e5}, 1e-3);
    detector.read_noise =
        number(section, "read_noise",
               "rms of a pixel; here and below electrons, of a bolometer mK at 300 K",
               detector.read_noise, noise);
    detector.row_noise = number(section, "row_noise", "of whole rows from frame to frame",
                                detector.row_noise, noise);
    detector.column_noise =
        number(section, "column_noise", "of whole columns likewise", detector.column_noise, noise);
    detector.frame_noise =
        number(section, "frame_noise", "of whole frames", detector.frame_noise, noise);
    detector.flicker_noise = number(section, "flicker_noise", "1/f, rms over 4096 frames",
                                    detector.flicker_noise, noise);
    detector.gain_spread =
        number(section, "gain_spread", "fixed pattern: rms share of pixels' gain",
               detector.gain_spread, share);
    detector.offset_spread =
        number(section, "offset_spread", "fixed pattern: rms of pixels' offset",
               detector.offset_spread, noise);
    detector.row_offset =
        number(section, "row_offset", "fixed pattern: rms of rows", detector.row_offset, noise);
    detector.column_offset = number(section, "column_offset", "fixed pattern: rms of columns",
                                    detector.column_offset, noise);
    detector.gain_drift =
        number(section, "gain_drift", "rms share an hour since the last correction",
               detector.gain_drift, share);
    detector.offset_drift =
        number(section, "offset_drift", "rms an hour since then", detector.offset_drift, noise);
    detector.dead = number(section, "dead", "share of the pixels", detector.dead, {0.0, 0.5});
    detector.blinking =
        number(section, "blinking", "share of the pixels that jump", detector.blinking, {0.0, 0.5});
    if (section.has("blink") && detector.blinking <= 0.0) {
        section.mistake("blink", "tells nothing where no pixels are blinking");
    }
    if (section.has("blink") && detector.blinking <= 0.0) {
        section.mistake("blink", "tells nothing where no pixels are blinking");
    }
    detector.blink = number(section, "blink", "by which they jump", detector.blink, noise);
}

void read_detector(const Section& section, Detector& detector) {
    detector.kind = section.choice_or(
        "kind", "it counts photons, or is warmed", detector.kind,
        {{"photon", DetectorKind::photon}, {"bolometer", DetectorKind::bolometer}});
    detector.pitch =
        number(section, "pixel_pitch_um", "of square pixels", detector.pitch, {0.1, 1e4}, 1e-6);
    detector.fill = number(section, "fill", "share of a pixel's area that is sensitive",
                           detector.fill, {0.01, 1.0});
    detector.efficiency = spectrum(section, "efficiency", "efficiency_curve",
                                   "quantum efficiency, of a bolometer its absorptance",
                                   "[[wavelength in µm, efficiency], ...] in place of efficiency",
                                   detector.efficiency);
    detector.temperature =
        number(section, "temperature_K", "of the detector", detector.temperature, {1.0, 400.0});
    if (detector.kind == DetectorKind::photon) {
        read_photons(section, detector);
    } else {
        detector.time_constant = number(section, "time_constant_ms", "in which it follows",
                                        detector.time_constant, {0.0, 1e4}, 1e-3);
    }
    read_noises(section, detector);
    if (section.has("netd_mK") && section.has("read_noise")) {
        section.mistake("read_noise", "stands beside netd_mK, which says it");
    } else if (section.has("read_noise")) {
        detector.netd = 0.0;
    }
    if (detector.kind == DetectorKind::bolometer && detector.netd <= 0.0 &&
        detector.read_noise <= 0.0) {
        section.mistake("netd_mK", "missing, a bolometer has netd_mK or read_noise");
    }
}

/// [low, high] of two numbers that ascend.
std::array<double, 2> pair(const Section& section, const char* key, const char* says,
                           const std::array<double, 2>& preset, Range range) {
    const std::vector<double> found =
        section.numbers_or(key, says, {std::vector{preset[0], preset[1]}, "the preset's"}, 2);
    if (found.size() == 2 && found[0] < found[1] && found[0] >= range.least &&
        found[1] <= range.most) {
        return {found[0], found[1]};
    }
    if (section.has(key)) {
        section.mistake(key, fmt::format("expected two numbers ascending within {:g} to {:g}",
                                         range.least, range.most));
    }
    return preset;
}

void read_correction(const Section& section, Correction& correction) {
    correction.kind =
        section.choice_or("kind", "of the fixed pattern, by even lights", correction.kind,
                          {{"none", CorrectionKind::none},
                           {"one_point", CorrectionKind::one_point},
                           {"two_point", CorrectionKind::two_point}});
    const bool by_well = section.has("well_shares");
    if (by_well && section.has("temperatures_K")) {
        section.mistake("well_shares", "stands beside temperatures_K");
    }
    correction.well = pair(section, "well_shares",
                           "of lights that fill these shares of the well, in place of black bodies",
                           correction.well, {0.0, 1.0});
    const std::array<double, 2> bodies =
        pair(section, "temperatures_K", "of black bodies; one_point has the first alone",
             correction.temperature[0] > 0.0 ? correction.temperature
                                             : std::array<double, 2>{290.0, 310.0},
             {150.0, 2000.0});
    if (by_well) {
        correction.temperature = {0.0, 0.0};
    } else if (section.has("temperatures_K")) {
        correction.temperature = bodies;
    }
    correction.housing_temperature =
        section.number_or("housing_temperature_K", "of the lens at the correction",
                          {correction.housing_temperature, "as in the pictures"}, {0.0, 500.0});
    correction.interval = number(section, "interval_min", "after which it is done anew",
                                 correction.interval, {0.01, 1e6}, 60.0);
    correction.replace_dead = section.flag_or(
        "replace_dead", "dead pixels show the mean of their neighbours", correction.replace_dead);
}

void read_electronics(const Section& section, DetectorKind kind, Electronics& electronics) {
    electronics.bits =
        section.integer_or("bits", "of the counts", {electronics.bits, "the preset's"}, {8, 16});
    electronics.gain = number(section, "gain",
                              "1: a full well, or the range's top, is the greatest "
                              "count",
                              electronics.gain, {1e-6, 1e6});
    electronics.black_level =
        number(section, "black_level", "counts without light", electronics.black_level,
               {0.0, double((1 << electronics.bits) - 2)});
    if (kind == DetectorKind::bolometer) {
        electronics.range = pair(section, "range_K", "of black bodies from count 0 to the greatest",
                                 electronics.range, {100.0, 3000.0});
    }
    electronics.frame_rate = number(section, "frame_rate_Hz",
                                    "pictures nearer than a frame have "
                                    "the same noise",
                                    electronics.frame_rate, {1e-3, 1e6});
    electronics.display = section.choice_or(
        "display", "of the picture of 8 bits", electronics.display,
        {{"linear", Display::linear}, {"plateau", Display::plateau}, {"manual", Display::manual}});
    if (electronics.display == Display::linear) {
        const auto [low, high] =
            pair(section, "shares", "of the pixels that are black, and that are not white",
                 {electronics.low, electronics.high}, {0.0, 1.0});
        electronics.low = low;
        electronics.high = high;
    } else if (electronics.display == Display::plateau) {
        electronics.plateau = number(section, "plateau",
                                     "most of the pixels that a count may take "
                                     "room for",
                                     electronics.plateau, {1e-6, 1.0});
    } else {
        electronics.level = section.number("level", "counts that are mid-grey", {0.0, 65535.0});
        electronics.span = section.number("span", "counts from black to white", {1.0, 65535.0});
    }
    electronics.black_hot =
        section.flag_or("black_hot", "the display's dark is warm", electronics.black_hot);
}

/// What only a correction of the fixed pattern gives a meaning.
void check_uncorrected(const Section& section) {
    const Section correction = section.section("correction", "of the detector's fixed pattern");
    for (const char* key :
         {"well_shares", "temperatures_K", "housing_temperature_K", "interval_min"}) {
        if (correction.has(key)) correction.mistake(key, "tells nothing where none is made");
    }
    const Section detector = section.section("detector", "what it sees with");
    for (const char* key : {"gain_drift", "offset_drift"}) {
        if (!detector.has(key)) continue;
        detector.mistake(key, "is since the last correction, of which there is none");
    }
}

}  // namespace

Instrument read_instrument(const Section& section) {
    const std::vector<std::string> known = preset_names();
    const std::string kind =
        section.word_or("preset", "a generic camera, whose numbers stand where the file says none",
                        "cooled_mwir", known);
    Instrument instrument =
        preset(std::find(known.begin(), known.end(), kind) == known.end() ? "cooled_mwir" : kind);
    instrument.name = section.text_or("name", "of the instrument", {kind, "preset"});
    instrument.oversampling = section.integer_or(
        "oversampling", "samples of radiance a pixel, each way", {0, "as the blur needs"}, {1, 12});
    read_optics(section.section("optics", "its lens"), instrument.lens);
    read_blur(section.section("blur", "of its picture, beside the pixels' size"), instrument.blur);
    read_detector(section.section("detector", "what it sees with"), instrument.detector);
    read_correction(section.section("correction", "of the detector's fixed pattern"),
                    instrument.correction);
    if (instrument.correction.kind == CorrectionKind::none) {
        const Section correction = section.section("correction", "of the detector's fixed pattern");
        for (const char* key :
             {"well_shares", "temperatures_K", "housing_temperature_K", "interval_min"}) {
            if (correction.has(key)) correction.mistake(key, "tells nothing where none is made");
        }
        const Section detector = section.section("detector", "what it sees with");
        for (const char* key : {"gain_drift", "offset_drift"}) {
            if (detector.has(key)) {
                detector.mistake(key, "is since the last correction, of which there is none");
            }
        }
    }
    if (instrument.correction.kind == CorrectionKind::none) check_uncorrected(section);
    read_electronics(section.section("electronics", "counts and display"), instrument.detector.kind,
                     instrument.electronics);
    return instrument;
}

}  // namespace diurna
