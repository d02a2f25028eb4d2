#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "materials/radiation/planck.hpp"
#include "render/instrument/camera.hpp"

namespace diurna::testing {

/// A camera for 3 to 5 µm without any fault but what its physics asks: F/2.5, 15 µm.
inline Instrument plain_instrument() {
    Instrument camera;
    camera.lens = {.f_number = 2.5, .transmission = flat_spectrum(0.9), .cos4 = false};
    camera.detector = {
        .pitch = 15e-6, .efficiency = flat_spectrum(0.8), .integration_time = 0.002, .well = 2e7};
    camera.correction.kind = CorrectionKind::none;
    camera.electronics = {.bits = 16};
    return camera;
}

/// Flux of a black body that fills the field.
inline std::vector<float> even_flux(const Camera& camera, double temperature) {
    return std::vector<float>(std::size_t(camera.width) * std::size_t(camera.height),
                              static_cast<float>(camera.response.black_body(temperature)));
}

/// What a camera sees, `at` giving the radiance as the mean over the square of a sample: of its
/// upper left corner and its side, in pixels from the picture's upper left corner.
inline std::vector<float> oversampled(const Camera& camera,
                                      const std::function<double(double, double, double)>& at) {
    std::vector<float> radiance;
    const double side = 1.0 / camera.oversampling.times;
    for (int row = 0; row < camera.seen_height(); ++row) {
        for (int column = 0; column < camera.seen_width(); ++column) {
            radiance.push_back(static_cast<float>(
                at(column * side - camera.margin, row * side - camera.margin, side)));
        }
    }
    return radiance;
}

struct Moments {
    double mean = 0.0, deviation = 0.0;
};
template <class Values>
Moments moments_of(const Values& values) {
    double sum = 0.0, squares = 0.0;
    for (const auto value : values) sum += double(value);
    const double mean = sum / double(values.size());
    for (const auto value : values) squares += (double(value) - mean) * (double(value) - mean);
    return {mean, std::sqrt(squares / double(values.size() - 1))};
}

}  // namespace diurna::testing
