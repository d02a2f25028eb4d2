#include "render/instrument/presets.hpp"

#include <functional>
#include <map>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

// Numbers are rounded figures of their class. Where from:
// - cooled: makers' data sheets of 640 x 512 InSb cameras (15 µm pitch, f/2.5, well of 7 Me-, 14
//   bits, NETD below 20 mK, 99.5 % of pixels good); quantum efficiency of coated InSb 0.8 to 0.9:
//   Rogalski, "Infrared Detectors", 2nd ed. (2011), ch. 12
// - uncooled: data sheets of 12 µm vanadium oxide cores (NETD 40 to 50 mK at f/1, time constant 8
//   to 12 ms, 60 Hz); absorptance 0.8: Kruse, "Uncooled Thermal Imaging" (2001), ch. 3
// - SWIR: data sheets of 15 µm InGaAs cameras (efficiency 0.8 from 1.0 to 1.6 µm, some 50 e- read,
//   well of 0.1 to 1 Me-, dark current of tens of thousands e-/s near 15 °C)
// - visible: EMVA 1288 reports of cameras of 3.45 µm CMOS with a global shutter (efficiency 0.64 at
//   0.53 µm, 2.4 e- read, 10.5 ke-, response even to 0.6 %)
// - lenses: transmission of coated germanium and silicon lenses 0.85 to 0.9, of glass 0.9; veiling
//   glare of 1 to 3 %: ISO 9358's usual range; wavefront errors of λ/14 (Maréchal) and more
// - residual row and column noise a fifth to a half of a pixel's: D'Agostino & Webb (1991), Holst,
//   "Testing and Evaluation of Infrared Imaging Systems" (1998), ch. 8
// - nodes of 15 µm InSb hold 7 Me- in some 1 pF; their kTC is taken away by double sampling, or is
//   small beside counting

Spectrum curve(std::vector<double> wavelength_um, std::vector<double> value) {
    return {std::move(wavelength_um), std::move(value)};
}

Instrument cooled_mwir() {
    Instrument camera;
    camera.lens = {.f_number = 2.5,
                   .transmission = flat_spectrum(0.88),
                   .housing_temperature = 300.0,
                   .cold_stop = true,
                   .vignetting = 0.05,
                   .k1 = -0.05,
                   .veiling_glare = 0.01,
                   .narcissus = 0.002};
    camera.blur = {.wavefront_error = 0.07, .diffusion_length = 2e-6, .jitter = 0.0};
    camera.detector = {.kind = DetectorKind::photon,
                       .pitch = 15e-6,
                       .fill = 0.9,
                       .efficiency = flat_spectrum(0.85),
                       .integration_time = 0.005,
                       .well_share = 0.7,
                       .well = 7e6,
                       .dark_current = 5e6,
                       .capacitance = 0.0,
                       .temperature = 77.0,
                       .read_noise = 700.0,
                       .row_noise = 150.0,
                       .column_noise = 150.0,
                       .flicker_noise = 150.0,
                       .gain_spread = 0.03,
                       .offset_spread = 40e3,
                       .row_offset = 5e3,
                       .column_offset = 10e3,
                       .gain_drift = 0.0001,
                       .offset_drift = 300.0,
                       .nonlinearity = 0.01,
                       .dead = 0.003,
                       .blinking = 0.0003,
                       .blink = 20e3};
    camera.correction.temperature = {288.0, 318.0};
    camera.electronics = {.bits = 14, .frame_rate = 60.0, .plateau = 0.01};
    return camera;
}

Instrument uncooled_lwir() {
    Instrument camera;
    camera.lens = {.f_number = 1.0,
                   .transmission = flat_spectrum(0.88),
                   .housing_temperature = 300.0,
                   .cold_stop = false,
                   .vignetting = 0.1,
                   .k1 = -0.1,
                   .veiling_glare = 0.02};
    camera.blur = {.wavefront_error = 0.08};
    camera.detector = {.kind = DetectorKind::bolometer,
                       .pitch = 12e-6,
                       .fill = 0.85,
                       .efficiency = flat_spectrum(0.8),
                       .temperature = 300.0,
                       .netd = 0.045,
                       .row_noise = 8.0,
                       .column_noise = 12.0,
                       .flicker_noise = 15.0,
                       .time_constant = 0.010,
                       .gain_spread = 0.04,
                       .offset_spread = 2000.0,
                       .row_offset = 100.0,
                       .column_offset = 300.0,
                       .gain_drift = 0.0005,
                       .offset_drift = 120.0,
                       .dead = 0.002,
                       .blinking = 0.0005,
                       .blink = 500.0};
    camera.correction.temperature = {288.0, 318.0};
    camera.correction.interval = 600.0;  // its shutter's
    camera.electronics = {.bits = 14, .frame_rate = 60.0, .plateau = 0.01};
    return camera;
}

Instrument swir() {
    Instrument camera;
    camera.lens = {.f_number = 2.0,
                   .transmission = flat_spectrum(0.9),
                   .housing_temperature = 300.0,
                   .cold_stop = false,
                   .vignetting = 0.1,
                   .k1 = -0.05,
                   .veiling_glare = 0.02};
    camera.blur = {.wavefront_error = 0.15, .diffusion_length = 2e-6};
    camera.detector = {.kind = DetectorKind::photon,
                       .pitch = 15e-6,
                       .fill = 1.0,
                       .efficiency = curve({0.85, 0.95, 1.0, 1.6, 1.65, 1.7, 1.75},
                                           {0.0, 0.7, 0.8, 0.8, 0.7, 0.3, 0.0}),
                       .integration_time = 0.016,
                       .well_share = 0.7,
                       .well = 2e5,
                       .dark_current = 3e4,
                       .temperature = 288.0,
                       .read_noise = 50.0,
                       .row_noise = 8.0,
                       .column_noise = 8.0,
                       .gain_spread = 0.03,
                       .offset_spread = 400.0,
                       .column_offset = 150.0,
                       .gain_drift = 0.0003,
                       .offset_drift = 10.0,
                       .nonlinearity = 0.01,
                       .dead = 0.003,
                       .blinking = 0.0003,
                       .blink = 1000.0};
    camera.correction.temperature = {0.0, 0.0};
    camera.electronics = {
        .bits = 14, .black_level = 256.0, .frame_rate = 60.0, .display = Display::linear};
    return camera;
}

Instrument visible() {
    Instrument camera;
    camera.lens = {.f_number = 4.0,
                   .transmission = flat_spectrum(0.9),
                   .housing_temperature = 295.0,
                   .cold_stop = false,
                   .vignetting = 0.15,
                   .k1 = -0.08,
                   .veiling_glare = 0.02};
    camera.blur = {.wavefront_error = 0.15, .diffusion_length = 0.3e-6};
    camera.detector = {
        .kind = DetectorKind::photon,
        .pitch = 3.45e-6,
        .fill = 1.0,
        .efficiency = curve({0.35, 0.4, 0.45, 0.53, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0},
                            {0.2, 0.42, 0.56, 0.64, 0.58, 0.5, 0.41, 0.24, 0.1, 0.02}),
        .integration_time = 0.03,
        .well_share = 0.8,
        .well = 10500.0,
        .dark_current = 5.0,
        .temperature = 310.0,
        .read_noise = 2.4,
        .row_noise = 0.3,
        .column_noise = 0.3,
        .gain_spread = 0.006,
        .offset_spread = 1.0,
        .column_offset = 0.3,
        .dead = 0.00002};
    camera.correction.kind = CorrectionKind::none;
    camera.correction.temperature = {0.0, 0.0};
    camera.electronics = {
        .bits = 12, .black_level = 64.0, .frame_rate = 30.0, .display = Display::linear};
    return camera;
}

const std::map<std::string, std::function<Instrument()>>& presets() {
    static const std::map<std::string, std::function<Instrument()>> all{
        {"cooled_mwir", cooled_mwir},
        {"swir", swir},
        {"uncooled_lwir", uncooled_lwir},
        {"visible", visible}};
    return all;
}

}  // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& [name, make] : presets()) names.push_back(name);
    return names;
}

Instrument preset(const std::string& name) {
    const auto found = presets().find(name);
    if (found == presets().end()) {
        throw InputError("preset", "unknown instrument \"" + name + "\"",
                         did_you_mean(name, preset_names()));
    }
    Instrument camera = found->second();
    camera.name = name;
    return camera;
}

}  // namespace diurna
