#include "render/instrument/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/instrument/distortion.hpp"
#include "render/instrument/draws.hpp"

namespace diurna {

namespace {

constexpr int blur_reach = 8;  // pixels that a blur and the tiling of the picture may reach
constexpr std::int64_t blink_frames = 8;  // that a blinking pixel stays as it is

/// Where a pixel's middle would be without distortion [pixels from the axis].
Eigen::Vector2d ideal(const Instrument& instrument, double focal_length,
                      const Eigen::Vector2d& pixel) {
    if (!distorts(instrument.lens)) return pixel;
    const double per_pixel = instrument.detector.pitch / focal_length;
    return undistorted(instrument.lens, pixel * per_pixel) / per_pixel;
}

/// How far beyond the picture's edges its border looks [pixels].
double overshoot(const Instrument& instrument, int width, int height, double focal_length) {
    double most = 0.0;
    const auto look = [&](double x, double y) {
        const Eigen::Vector2d at = ideal(instrument, focal_length, {x, y});
        most = std::max({most, std::abs(at.x()) - 0.5 * width, std::abs(at.y()) - 0.5 * height});
    };
    const int steps = 64;
    for (int i = 0; i <= steps; ++i) {
        const double along = double(i) / steps - 0.5;
        for (const double side : {-0.5, 0.5}) {
            look(along * width, side * height);
            look(side * width, along * height);
        }
    }
    return most;
}

/// Catmull and Rom's weights of the four samples about a place, `t` after the second.
std::array<double, 4> weights(double t) {
    return {0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
            0.5 * t * (t * (4.0 - 3.0 * t) + 1.0), 0.5 * t * t * (t - 1.0)};
}

double between(std::span<const float> picture, int width, int height, double x, double y) {
    const double cx = std::floor(x), cy = std::floor(y);
    const auto wx = weights(x - cx), wy = weights(y - cy);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
        const int row = std::clamp(int(cy) + j - 1, 0, height - 1);
        for (int i = 0; i < 4; ++i) {
            const int column = std::clamp(int(cx) + i - 1, 0, width - 1);
            sum += wy[std::size_t(j)] * wx[std::size_t(i)] *
                   double{picture[std::size_t(row) * std::size_t(width) + std::size_t(column)]};
        }
    }
    return sum;
}

bool is_photon(const Camera& camera) {
    return camera.instrument.detector.kind == DetectorKind::photon;
}

double dark_flux(const Camera& camera) {
    return is_photon(camera) ? camera.instrument.detector.dark_current : 0.0;
}

double well_of(const Camera& camera) {
    return is_photon(camera) ? camera.instrument.detector.well
                             : signal_of(camera.instrument.electronics.range[1], camera.instrument,
                                         camera.response);
}

/// [s]; of a picture so bright that it would fill the well, less.
double integration_time_of(const Camera& camera, std::span<const float> flux) {
    if (!is_photon(camera)) return 1.0;
    const Detector& detector = camera.instrument.detector;
    if (detector.well_share <= 0.0 || flux.empty()) return detector.integration_time;
    std::vector<float> sorted(flux.begin(), flux.end());
    const auto place = std::ptrdiff_t(0.99 * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
    const double brightest = double{sorted[std::size_t(place)]} + camera.response.lens +
                             camera.response.beside + dark_flux(camera);
    return std::min(detector.integration_time, detector.well_share * detector.well / brightest);
}

/// Even lights by which the pattern is corrected: what the axis gets of each [signal].
struct EvenLights {
    double scene[2];
    double shown[2];
};

EvenLights even_lights(const Camera& camera, double time) {
    const Correction& correction = camera.instrument.correction;
    EvenLights lights{};
    const Response& then = camera.corrected_response;
    for (std::size_t i = 0; i < 2; ++i) {
        lights.scene[i] = correction.temperature[i] > 0.0
                              ? time * then.black_body(correction.temperature[i])
                              : correction.well[i] * well_of(camera);
        lights.shown[i] = lights.scene[i] + time * (then.lens + then.beside + dark_flux(camera));
    }
    return lights;
}

PixelCorrection correction_of(const Camera& camera, const EvenLights& lights, std::size_t p,
                              double time) {
    const CorrectionKind kind = camera.instrument.correction.kind;
    if (kind == CorrectionKind::none) return {};
    double seen[2];
    for (std::size_t i = 0; i < 2; ++i) {
        seen[i] = double{camera.corrected_field.light[p]} * lights.scene[i] +
                  time * (double{camera.corrected_field.background[p]} + dark_flux(camera));
    }
    const double well = well_of(camera);
    return kind == CorrectionKind::two_point
               ? two_point(camera.pattern, p, well, seen, lights.shown)
               : one_point(camera.pattern, p, well, seen[0], lights.shown[0]);
}

/// Noise that a whole row, a column or the frame share.
struct LineNoise {
    double frame = 0.0;
    std::vector<double> row, column;
};

LineNoise line_noise(const Camera& camera, std::int64_t frame) {
    const std::uint64_t seed = camera.instrument.seed, k = static_cast<std::uint64_t>(frame);
    LineNoise noise{0.0, std::vector<double>(std::size_t(camera.height), 0.0),
                    std::vector<double>(std::size_t(camera.width), 0.0)};
    if (camera.noise.frame > 0.0) {
        noise.frame = camera.noise.frame * normal(seed, Draw::frame, 0, k);
    }
    const auto fill = [&](std::vector<double>& line, double rms, Draw purpose) {
        for (std::size_t i = 0; rms > 0.0 && i < line.size(); ++i) {
            line[i] = rms * normal(seed, purpose, i, k);
        }
    };
    fill(noise.row, camera.noise.row, Draw::row);
    fill(noise.column, camera.noise.column, Draw::column);
    return noise;
}

double pixel_noise(const Camera& camera, double mean, std::size_t p, std::uint64_t k) {
    const std::uint64_t seed = camera.instrument.seed;
    double noise = 0.0;
    if (is_photon(camera) && camera.instrument.detector.shot_noise) {
        noise += counted(mean, seed, p, k) - mean;
    }
    if (camera.noise.pixel > 0.0) noise += camera.noise.pixel * normal(seed, Draw::pixel, p, k);
    if (camera.noise.flicker > 0.0) noise += camera.noise.flicker * flicker(seed, p, k);
    return noise;
}

double with_fate(const Camera& camera, double signal, std::size_t p, std::int64_t frame) {
    switch (camera.pattern.fate[p]) {
        case Fate::whole:
            return signal;
        case Fate::dark:
            return 0.0;
        case Fate::full:
            return well_of(camera);
        case Fate::blinking:
            return uniform(camera.instrument.seed, Draw::blink, p,
                           static_cast<std::uint64_t>(frame / blink_frames)) < 0.5
                       ? signal
                       : signal + noise_unit(camera.instrument.detector, camera.response) *
                                      camera.instrument.detector.blink;
    }
    return signal;
}

/// A two-point correction needs lights that differ by more than a pixel's offset does by chance.
void check_lights(const Instrument& instrument, const Response& response) {
    const Correction& correction = instrument.correction;
    if (correction.kind == CorrectionKind::none || correction.temperature[0] <= 0.0) return;
    const bool photon = instrument.detector.kind == DetectorKind::photon;
    const double time = photon ? instrument.detector.integration_time : 1.0;
    const double step = time * (response.black_body(correction.temperature[1]) -
                                response.black_body(correction.temperature[0]));
    const Noise noise = noise_of(instrument, response);
    const double least = std::hypot(
        noise.pixel,
        photon ? std::sqrt(signal_of(correction.temperature[1], instrument, response)) : 0.0);
    if (step > least) return;
    throw InputError(
        "instrument " + instrument.name,
        fmt::format("the black bodies of {:g} and {:g} K differ by {:.3g} {} in the band, less "
                    "than the noise of {:.3g}: the fixed pattern cannot be corrected",
                    correction.temperature[0], correction.temperature[1], step, response.unit,
                    least),
        "use correction.well_shares or warmer black bodies");
}

int margin_of(const Instrument& instrument, int width, int height, double focal_length) {
    const double beyond = overshoot(instrument, width, height, focal_length);
    if (beyond > 0.25 * std::max(width, height)) {
        throw InputError("instrument " + instrument.name,
                         fmt::format("the lens distortion extends {:.0f} pixels beyond a picture "
                                     "of {} x {}, more than a quarter of it",
                                     beyond, width, height));
    }
    return blur_reach + static_cast<int>(std::ceil(std::max(0.0, beyond)));
}

}  // namespace

void check_camera(const Instrument& instrument, const Band& band, int width, int height,
                  double focal_length) {
    const Response response = response_of(instrument, band);
    noise_of(instrument, response);
    check_lights(instrument, response);
    margin_of(instrument, width, height, focal_length);
}

Camera camera_of(const Instrument& instrument, const Band& band, int width, int height,
                 double focal_length) {
    Response response = response_of(instrument, band);
    const double then = instrument.correction.housing_temperature;
    Response corrected = response_of(instrument, band, then);
    SystemMtf mtf(instrument, band, focal_length);
    Oversampling oversampling = oversampling_of(instrument, mtf);
    const int margin = margin_of(instrument, width, height, focal_length);
    check_lights(instrument, response);
    const int times = oversampling.times;
    Convolution blur = system_blur(mtf, instrument.detector.pitch, times,
                                   (width + 2 * margin) * times, (height + 2 * margin) * times);
    LensField field = lens_field(instrument, response, width, height, focal_length);
    LensField corrected_field = lens_field(instrument, corrected, width, height, focal_length);
    Noise noise = noise_of(instrument, response);
    Pattern pattern = pattern_of(instrument.detector, instrument.seed, width, height,
                                 noise_unit(instrument.detector, response));
    return {.instrument = instrument,
            .width = width,
            .height = height,
            .focal_length = focal_length,
            .response = std::move(response),
            .corrected_response = std::move(corrected),
            .mtf = std::move(mtf),
            .oversampling = std::move(oversampling),
            .margin = margin,
            .blur = std::move(blur),
            .field = std::move(field),
            .corrected_field = std::move(corrected_field),
            .pattern = std::move(pattern),
            .noise = noise};
}

std::vector<float> see(const Camera& camera, std::span<const float> radiance) {
    const int times = camera.oversampling.times;
    if (radiance.size() != std::size_t(camera.seen_width()) * std::size_t(camera.seen_height())) {
        throw InputError("instrument " + camera.instrument.name,
                         "the radiance does not have the camera's picture size");
    }
    const std::vector<float> sharp_no_more = camera.blur(radiance);
    std::vector<float> flux(std::size_t(camera.width) * std::size_t(camera.height));
    // Pixels' middles in samples: half a sample more where their number is even (system_blur).
    const double shift = times % 2 == 0 ? 1.0 : 0.5;
    for_each_index(
        std::size_t(camera.height),
        [&](std::size_t row) {
            for (int column = 0; column < camera.width; ++column) {
                const Eigen::Vector2d at = ideal(
                    camera.instrument, camera.focal_length,
                    {column + 0.5 - 0.5 * camera.width, double(row) + 0.5 - 0.5 * camera.height});
                const double x = (at.x() + 0.5 * camera.width + camera.margin) * times - shift;
                const double y = (at.y() + 0.5 * camera.height + camera.margin) * times - shift;
                flux[row * std::size_t(camera.width) + std::size_t(column)] =
                    static_cast<float>(std::max(0.0, between(sharp_no_more, camera.seen_width(),
                                                             camera.seen_height(), x, y)) *
                                       camera.response.per_radiance);
            }
        },
        8);
    spread_glare(camera.instrument.lens.veiling_glare, flux);
    return flux;
}

Shot take(const Camera& camera, std::span<const float> flux, std::int64_t frame, double hours) {
    const std::size_t pixels = std::size_t(camera.width) * std::size_t(camera.height);
    const double time = integration_time_of(camera, flux), well = well_of(camera);
    const EvenLights lights = even_lights(camera, time);
    const LineNoise lines = line_noise(camera, frame);
    Shot shot{.integration_time = time,
              .signal = std::vector<float>(pixels),
              .measured = std::vector<float>(pixels),
              .counts = std::vector<std::uint16_t>(pixels)};
    std::atomic<std::size_t> saturated = 0;
    for_each_block(pixels, 8192, [&](std::size_t begin, std::size_t end) {
        std::size_t full = 0;
        for (std::size_t p = begin; p < end; ++p) {
            const double scene = time * double{flux[p]} * double{camera.field.light[p]};
            const double mean =
                scene + time * (double{camera.field.background[p]} + dark_flux(camera));
            double signal = camera.pattern.answer(p, mean, well, hours) +
                            pixel_noise(camera, mean, p, static_cast<std::uint64_t>(frame)) +
                            lines.frame + lines.row[p / std::size_t(camera.width)] +
                            lines.column[p % std::size_t(camera.width)];
            signal = with_fate(camera, signal, p, frame);
            if (is_photon(camera)) {
                full += signal >= well && camera.pattern.fate[p] == Fate::whole ? 1 : 0;
                signal = std::min(signal, well);  // noise goes below zero; counts do not
            }
            const PixelCorrection correction = correction_of(camera, lights, p, time);
            shot.signal[p] = static_cast<float>(scene);
            shot.measured[p] = static_cast<float>(correction.scale * signal + correction.shift);
        }
        saturated += full;
    });
    shot.saturated = saturated;
    if (camera.instrument.correction.replace_dead) {
        shot.dead = replace_dead(camera.pattern, shot.measured);
    } else {
        shot.dead = std::size_t(
            std::count_if(camera.pattern.fate.begin(), camera.pattern.fate.end(),
                          [](Fate fate) { return fate == Fate::dark || fate == Fate::full; }));
    }
    const CountScale scale = count_scale(camera);
    const double most = double((1 << camera.instrument.electronics.bits) - 1);
    for (std::size_t p = 0; p < pixels; ++p) {
        shot.counts[p] = static_cast<std::uint16_t>(
            std::lround(std::clamp(scale.counts(double{shot.measured[p]}), 0.0, most)));
    }
    return shot;
}

std::int64_t frame_number(const Instrument& instrument, double seconds) {
    return std::llround(seconds * instrument.electronics.frame_rate);
}

double hours_since_correction(const Instrument& instrument, double seconds) {
    const double interval = instrument.correction.interval;
    if (instrument.correction.kind == CorrectionKind::none || interval <= 0.0) return 0.0;
    const double phase = uniform(instrument.seed, Draw::phase, 0);
    const double since = seconds / interval + phase;
    return (since - std::floor(since)) * interval / 3600.0;
}

CountScale count_scale(const Camera& camera) {
    const Electronics& electronics = camera.instrument.electronics;
    const double most = double((1 << electronics.bits) - 1);
    if (is_photon(camera)) {
        return {electronics.black_level, electronics.gain * (most - electronics.black_level) /
                                             camera.instrument.detector.well};
    }
    const double low = signal_of(electronics.range[0], camera.instrument, camera.response);
    const double high = signal_of(electronics.range[1], camera.instrument, camera.response);
    const double per_signal = electronics.gain * most / (high - low);
    return {electronics.black_level - per_signal * low, per_signal};
}

std::vector<std::string> left_out(const Instrument& instrument) {
    const Lens& lens = instrument.lens;
    const Blur& blur = instrument.blur;
    const Detector& detector = instrument.detector;
    const bool photon = detector.kind == DetectorKind::photon;
    std::vector<std::string> lines;
    const auto tell = [&](bool there, const char* what) {
        if (!there) lines.emplace_back(what);
    };
    tell(lens.cos4, "cos4");
    tell(lens.vignetting > 0.0, "vignetting");
    tell(distorts(lens), "distortion");
    tell(lens.veiling_glare > 0.0, "veiling glare");
    tell(lens.narcissus > 0.0, "narcissus");
    tell(blur.diffraction, "diffraction");
    tell(blur.defocus != 0.0, "defocus");
    tell(blur.wavefront_error > 0.0, "aberration");
    tell(blur.diffusion_length > 0.0, "diffusion");
    tell(blur.jitter > 0.0, "jitter");
    tell(!blur.drift.isZero(), "drift");
    tell(blur.turbulence_cn2 > 0.0, "turbulence");
    tell(!photon || detector.shot_noise, "shot noise");
    tell(!photon || detector.dark_current > 0.0, "dark current");
    tell(!photon || detector.capacitance > 0.0, "kTC noise");
    tell(detector.flicker_noise > 0.0, "1/f noise");
    tell(detector.row_noise > 0.0 || detector.column_noise > 0.0 || detector.frame_noise > 0.0,
         "noise of rows, columns, frames");
    tell(detector.gain_spread > 0.0 || detector.offset_spread > 0.0, "fixed pattern");
    tell(detector.gain_drift > 0.0 || detector.offset_drift > 0.0, "drift of the fixed pattern");
    tell(detector.nonlinearity > 0.0, "nonlinearity");
    tell(detector.dead > 0.0, "dead pixels");
    tell(detector.blinking > 0.0, "blinking pixels");
    tell(photon || detector.time_constant > 0.0, "time constant");
    tell(instrument.correction.kind != CorrectionKind::none, "correction of the fixed pattern");
    return lines;
}

}  // namespace diurna
