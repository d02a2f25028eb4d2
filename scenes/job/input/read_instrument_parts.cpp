#include "scenes/job/input/read_instrument_parts.hpp"

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
    return unit * section.number_or(key, says, {preset / unit, "from the preset"}, range);
}

/// One number for all wavelengths, or a curve as rows of wavelength and value.
Spectrum spectrum(const Section& section, const char* key, const char* curve_key, const char* says,
                  const char* curve_says, const Spectrum& preset) {
    if (section.has(curve_key)) {
        if (section.has(key))
            section.mistake(key, fmt::format("cannot be combined with {}", curve_key));
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
        section.number_or(key, says, {preset.value.front(), "from the preset"}, {0.0, 1.0});
    return section.has(key) ? flat_spectrum(share) : preset;
}

void read_optics(const Section& section, Lens& lens) {
    lens.f_number = number(section, "f_number",
                           "focal length divided by aperture; the focal length follows from the "
                           "observer's field of view and the pixel pitch",
                           lens.f_number, {0.5, 100.0});
    lens.transmission = spectrum(section, "transmission", "transmission_curve",
                                 "transmission of the lens; its emissivity is 1 - transmission",
                                 "[[wavelength in µm, transmission], ...] instead of transmission",
                                 lens.transmission);
    lens.housing_temperature =
        number(section, "housing_temperature_K", "temperature of lens and housing",
               lens.housing_temperature, {50.0, 500.0});
    lens.cold_stop = section.flag_or(
        "cold_stop",
        "the detector sees only the lens; false: it also sees the warm housing around it",
        lens.cold_stop);
    lens.cos4 = section.flag_or(
        "cos4", "reduce off-axis irradiance by the fourth power of the cosine", lens.cos4);
    lens.vignetting = number(section, "vignetting",
                             "share of the light that mounts block in the corners of the picture",
                             lens.vignetting, {0.0, 1.0});
    lens.k1 =
        number(section, "k1", "Brown's radial distortion, coefficient of r^2, r in focal lengths",
               lens.k1, {-1e4, 1e4});
    lens.k2 = number(section, "k2", "coefficient of r^4", lens.k2, {-1e7, 1e7});
    lens.k3 = number(section, "k3", "coefficient of r^6", lens.k3, {-1e9, 1e9});
    lens.p1 = number(section, "p1", "tangential distortion", lens.p1, {-1e3, 1e3});
    lens.p2 = number(section, "p2", "tangential distortion", lens.p2, {-1e3, 1e3});
    lens.veiling_glare = number(section, "veiling_glare",
                                "share of the light that is spread evenly over the picture",
                                lens.veiling_glare, {0.0, 1.0});
    lens.narcissus =
        number(section, "narcissus",
               "share of the lens, at the picture's centre, that reflects the cold detector",
               lens.narcissus, {0.0, 1.0});
    if (section.has("narcissus_radius") && lens.narcissus <= 0.0) {
        section.mistake("narcissus_radius", "has no effect without narcissus");
    }
    if (section.has("narcissus_radius") && lens.narcissus <= 0.0) {
        section.mistake("narcissus_radius", "has no effect without narcissus");
    }
    lens.narcissus_radius = number(section, "narcissus_radius",
                                   "distance in half diagonals at which narcissus falls to 1/e",
                                   lens.narcissus_radius, {0.01, 10.0});
}

void read_blur(const Section& section, Blur& blur) {
    blur.diffraction = section.flag_or(
        "diffraction", "diffraction by the round aperture, over the band", blur.diffraction);
    blur.wavefront_error =
        number(section, "wavefront_error", "rms wavefront error of the lens, in waves",
               blur.wavefront_error, {0.0, 0.18});
    blur.defocus = number(section, "defocus_um", "distance of the detector from the focus",
                          blur.defocus, {-1000.0, 1000.0}, 1e-6);
    blur.diffusion_length =
        number(section, "diffusion_length_um",
               "diffusion length of charge in the detector, MTF of exp(-x/length)",
               blur.diffusion_length, {0.0, 1000.0}, 1e-6);
    blur.jitter = number(section, "jitter_mrad", "rms jitter of the line of sight, per axis",
                         blur.jitter, {0.0, 100.0}, 1e-3);
    const std::vector<double> drift = section.numbers_or(
        "drift_mrad", "[right, down] drift of the line of sight during the exposure",
        {std::vector{1e3 * blur.drift.x(), 1e3 * blur.drift.y()}, "from the preset"}, 2);
    if (drift.size() == 2) blur.drift = {1e-3 * drift[0], 1e-3 * drift[1]};
    blur.turbulence_cn2 =
        number(section, "turbulence_cn2",
               "structure constant of the refractive index, in m^(-2/3): 1e-16 to 1e-12",
               blur.turbulence_cn2, {0.0, 1e-8});
    blur.turbulence_range = number(section, "turbulence_range_m",
                                   "path length for turbulence_cn2, the same for all pixels",
                                   blur.turbulence_range, {0.0, 1e6});
    if (blur.turbulence_cn2 > 0.0 && blur.turbulence_range <= 0.0) {
        section.mistake("turbulence_range_m", "missing, but turbulence_cn2 is given");
    }
    if (section.has("turbulence_range_m") && blur.turbulence_cn2 <= 0.0) {
        section.mistake("turbulence_range_m", "has no effect without turbulence_cn2");
    }
    if (section.has("turbulence_range_m") && blur.turbulence_cn2 <= 0.0) {
        section.mistake("turbulence_range_m", "has no effect without turbulence_cn2");
    }
    if (!blur.diffraction && (blur.defocus != 0.0 || section.has("wavefront_error"))) {
        section.mistake("diffraction",
                        "is false, but wavefront errors need the whole MTF of the lens");
    }
}

constexpr Range share{0.0, 1.0}, noise{0.0, 1e9};

void read_photons(const Section& section, Detector& detector) {
    detector.integration_time = number(section, "integration_time_ms", "longest integration time",
                                       detector.integration_time, {1e-6, 1e6}, 1e-3);
    detector.well_share = number(section, "well_share",
                                 "largest well fill of the brightest per cent of a picture: "
                                 "reduces integration_time_ms; 0: constant integration time",
                                 detector.well_share, share);
    detector.well = number(section, "well", "full-well capacity of a pixel, electrons",
                           detector.well, {10.0, 1e12});
    detector.dark_current = number(section, "dark_current", "dark current, electrons per second",
                                   detector.dark_current, {0.0, 1e15});
    detector.capacitance =
        number(section, "capacitance_fF",
               "capacitance of a pixel that is reset without double sampling (kTC noise)",
               detector.capacitance, {0.0, 1e9}, 1e-15);
    detector.shot_noise =
        section.flag_or("shot_noise", "photon and electron shot noise", detector.shot_noise);
    detector.nonlinearity =
        number(section, "nonlinearity",
               "signal loss at a full well, as a share; the rms over pixels is a tenth of it",
               detector.nonlinearity, {0.0, 0.3});
}

void read_noises(const Section& section, Detector& detector) {
    detector.netd = number(section, "netd_mK",
                           "noise-equivalent temperature difference at 300 K for all temporal "
                           "noise of a pixel, instead of read_noise",
                           detector.netd, {0.0, 1e5}, 1e-3);
    detector.read_noise = number(section, "read_noise",
                                 "rms read noise of a pixel; this and the following in electrons, "
                                 "for bolometers in mK at 300 K",
                                 detector.read_noise, noise);
    detector.row_noise =
        number(section, "row_noise", "rms noise of whole rows, different in each frame",
               detector.row_noise, noise);
    detector.column_noise =
        number(section, "column_noise", "rms noise of whole columns, different in each frame",
               detector.column_noise, noise);
    detector.frame_noise =
        number(section, "frame_noise", "rms noise of whole frames", detector.frame_noise, noise);
    detector.flicker_noise = number(section, "flicker_noise", "1/f noise, rms over 4096 frames",
                                    detector.flicker_noise, noise);
    detector.gain_spread =
        number(section, "gain_spread", "fixed pattern: rms relative spread of the pixels' gain",
               detector.gain_spread, share);
    detector.offset_spread =
        number(section, "offset_spread", "fixed pattern: rms spread of the pixels' offset",
               detector.offset_spread, noise);
    detector.row_offset = number(section, "row_offset", "fixed pattern: rms offset of rows",
                                 detector.row_offset, noise);
    detector.column_offset =
        number(section, "column_offset", "fixed pattern: rms offset of columns",
               detector.column_offset, noise);
    detector.gain_drift =
        number(section, "gain_drift", "rms gain drift per hour since the last correction",
               detector.gain_drift, share);
    detector.offset_drift =
        number(section, "offset_drift", "rms offset drift per hour since the last correction",
               detector.offset_drift, noise);
    detector.dead = number(section, "dead", "share of dead pixels", detector.dead, {0.0, 0.5});
    detector.blinking =
        number(section, "blinking", "share of blinking pixels", detector.blinking, {0.0, 0.5});
    if (section.has("blink") && detector.blinking <= 0.0) {
        section.mistake("blink", "has no effect without blinking pixels");
    }
    if (section.has("blink") && detector.blinking <= 0.0) {
        section.mistake("blink", "has no effect without blinking pixels");
    }
    detector.blink = number(section, "blink", "step of a blinking pixel", detector.blink, noise);
}

void read_detector(const Section& section, Detector& detector) {
    detector.kind = section.choice_or(
        "kind", "photon: counts photons; bolometer: is warmed by radiation", detector.kind,
        {{"photon", DetectorKind::photon}, {"bolometer", DetectorKind::bolometer}});
    detector.pitch = number(section, "pixel_pitch_um", "pitch of the square pixels", detector.pitch,
                            {0.1, 1e4}, 1e-6);
    detector.fill = number(section, "fill", "share of a pixel's area that is sensitive",
                           detector.fill, {0.01, 1.0});
    detector.efficiency = spectrum(section, "efficiency", "efficiency_curve",
                                   "quantum efficiency; for a bolometer its absorptance",
                                   "[[wavelength in µm, efficiency], ...] instead of efficiency",
                                   detector.efficiency);
    detector.temperature = number(section, "temperature_K", "temperature of the detector",
                                  detector.temperature, {1.0, 400.0});
    if (detector.kind == DetectorKind::photon) {
        read_photons(section, detector);
    } else {
        detector.time_constant =
            number(section, "time_constant_ms", "thermal time constant of a bolometer",
                   detector.time_constant, {0.0, 1e4}, 1e-3);
    }
    read_noises(section, detector);
    if (section.has("netd_mK") && section.has("read_noise")) {
        section.mistake("read_noise", "cannot be combined with netd_mK, which sets the noise");
    } else if (section.has("read_noise")) {
        detector.netd = 0.0;
    }
    if (detector.kind == DetectorKind::bolometer && detector.netd <= 0.0 &&
        detector.read_noise <= 0.0) {
        section.mistake("netd_mK", "missing, a bolometer needs netd_mK or read_noise");
    }
}

/// [low, high] of two numbers that ascend.
std::array<double, 2> pair(const Section& section, const char* key, const char* says,
                           const std::array<double, 2>& preset, Range range) {
    const std::vector<double> found =
        section.numbers_or(key, says, {std::vector{preset[0], preset[1]}, "from the preset"}, 2);
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
    correction.kind = section.choice_or(
        "kind", "correction of the fixed pattern by uniform sources", correction.kind,
        {{"none", CorrectionKind::none},
         {"one_point", CorrectionKind::one_point},
         {"two_point", CorrectionKind::two_point}});
    const bool by_well = section.has("well_shares");
    if (by_well && section.has("temperatures_K")) {
        section.mistake("well_shares", "cannot be combined with temperatures_K");
    }
    correction.well =
        pair(section, "well_shares",
             "uniform sources that fill these shares of the well, instead of black bodies",
             correction.well, {0.0, 1.0});
    const std::array<double, 2> bodies = pair(
        section, "temperatures_K", "temperatures of the black bodies; one_point has only the first",
        correction.temperature[0] > 0.0 ? correction.temperature
                                        : std::array<double, 2>{290.0, 310.0},
        {150.0, 2000.0});
    if (by_well) {
        correction.temperature = {0.0, 0.0};
    } else if (section.has("temperatures_K")) {
        correction.temperature = bodies;
    }
    correction.housing_temperature =
        section.number_or("housing_temperature_K", "temperature of the lens during the correction",
                          {correction.housing_temperature, "as in the pictures"}, {0.0, 500.0});
    correction.interval = number(section, "interval_min", "interval between corrections",
                                 correction.interval, {0.01, 1e6}, 60.0);
    correction.replace_dead =
        section.flag_or("replace_dead", "replace dead pixels by the mean of their neighbours",
                        correction.replace_dead);
}

void read_electronics(const Section& section, DetectorKind kind, Electronics& electronics) {
    electronics.bits = section.integer_or("bits", "bits per count",
                                          {electronics.bits, "from the preset"}, {8, 16});
    electronics.gain =
        number(section, "gain", "1: the greatest count is a full well, or the top of the range",
               electronics.gain, {1e-6, 1e6});
    electronics.black_level =
        number(section, "black_level", "count without light", electronics.black_level,
               {0.0, double((1 << electronics.bits) - 2)});
    if (kind == DetectorKind::bolometer) {
        electronics.range =
            pair(section, "range_K", "black-body temperatures of count 0 and the greatest count",
                 electronics.range, {100.0, 3000.0});
    }
    electronics.frame_rate =
        number(section, "frame_rate_Hz",
               "frame rate; pictures closer together than one frame have the same noise",
               electronics.frame_rate, {1e-3, 1e6});
    electronics.display = section.choice_or(
        "display", "contrast mapping of the 8-bit picture", electronics.display,
        {{"linear", Display::linear}, {"plateau", Display::plateau}, {"manual", Display::manual}});
    if (electronics.display == Display::linear) {
        const auto [low, high] =
            pair(section, "shares", "shares of pixels that are black, and that are not white",
                 {electronics.low, electronics.high}, {0.0, 1.0});
        electronics.low = low;
        electronics.high = high;
    } else if (electronics.display == Display::plateau) {
        electronics.plateau = number(section, "plateau",
                                     "largest number of pixels that a count contributes to the "
                                     "mapping (plateau equalisation)",
                                     electronics.plateau, {1e-6, 1.0});
    } else {
        electronics.level = section.number("level", "count shown as mid-grey", {0.0, 65535.0});
        electronics.span = section.number("span", "counts from black to white", {1.0, 65535.0});
    }
    electronics.black_hot =
        section.flag_or("black_hot", "hot pixels are dark", electronics.black_hot);
}

/// What only a correction of the fixed pattern gives a meaning.
void check_uncorrected(const Section& section) {
    const Section correction =
        section.section("correction", "correction of the detector's fixed pattern");
    for (const char* key :
         {"well_shares", "temperatures_K", "housing_temperature_K", "interval_min"}) {
        if (correction.has(key)) correction.mistake(key, "has no effect without a correction");
    }
    const Section detector = section.section("detector", "the detector");
    for (const char* key : {"gain_drift", "offset_drift"}) {
        if (!detector.has(key)) continue;
        detector.mistake(key, "is a drift since the last correction, but there is no correction");
    }
}

}  // namespace

Instrument read_instrument(const Section& section) {
    const std::vector<std::string> known = preset_names();
    const std::string kind = section.word_or(
        "preset", "a generic camera, which sets all values that the file does not give",
        "cooled_mwir", known);
    Instrument instrument =
        preset(std::find(known.begin(), known.end(), kind) == known.end() ? "cooled_mwir" : kind);
    instrument.name = section.text_or("name", "name of the instrument", {kind, "preset"});
    instrument.oversampling = section.integer_or(
        "oversampling", "radiance samples per pixel and axis", {0, "as the blur needs"}, {1, 12});
    read_optics(section.section("optics", "the lens"), instrument.lens);
    read_blur(section.section("blur", "blur of the picture, in addition to the pixel size"),
              instrument.blur);
    read_detector(section.section("detector", "the detector"), instrument.detector);
    read_correction(section.section("correction", "correction of the detector's fixed pattern"),
                    instrument.correction);
    if (instrument.correction.kind == CorrectionKind::none) {
        const Section correction =
            section.section("correction", "correction of the detector's fixed pattern");
        for (const char* key :
             {"well_shares", "temperatures_K", "housing_temperature_K", "interval_min"}) {
            if (correction.has(key)) correction.mistake(key, "has no effect without a correction");
        }
        const Section detector = section.section("detector", "the detector");
        for (const char* key : {"gain_drift", "offset_drift"}) {
            if (detector.has(key)) {
                detector.mistake(
                    key, "is a drift since the last correction, but there is no correction");
            }
        }
    }
    if (instrument.correction.kind == CorrectionKind::none) check_uncorrected(section);
    read_electronics(section.section("electronics", "counts and display"), instrument.detector.kind,
                     instrument.electronics);
    return instrument;
}

}  // namespace diurna
