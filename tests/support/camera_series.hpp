#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/plain_camera.hpp"

/// Pictures of even light, and what a closed form says of them.
namespace diurna::testing {

inline constexpr double light_speed = 299792458.0, planck_h = 6.62607015e-34,
                        boltzmann_k = 1.380649e-23;

/// Photons of a black body at wavelengths up to `um` [s⁻¹ m⁻² sr⁻¹]: the series of
/// 2c (kT/hc)³ ∫ u²/(eᵘ − 1) du from hc/λkT on.
inline double photons_to(double um, double temperature) {
    const double x = planck_h * light_speed / (um * 1e-6 * boltzmann_k * temperature);
    double sum = 0.0;
    for (int n = 1; n <= 60; ++n) {
        sum += std::exp(-n * x) * (x * x / n + 2.0 * x / (n * n) + 2.0 / (double(n) * n * n));
    }
    return 2.0 * light_speed * std::pow(boltzmann_k * temperature / (planck_h * light_speed), 3) *
           sum;
}
inline double photons(double from_um, double to_um, double temperature) {
    return photons_to(to_um, temperature) - photons_to(from_um, temperature);
}

/// Electrons of the plain instrument before a black body: A Ω t τ QE times its photons.
inline double electrons(const Instrument& i, double temperature) {
    const double solid = std::numbers::pi / (4.0 * i.lens.f_number * i.lens.f_number + 1.0);
    return i.detector.pitch * i.detector.pitch * solid * i.detector.integration_time * 0.9 * 0.8 *
           photons(3.0, 5.0, temperature);
}

inline Camera camera_for(const Instrument& instrument, int width = 64, int height = 64) {
    return camera_of(instrument, flat_band("3-5", 3.0, 5.0), width, height, 0.05);
}

/// Pictures of one even light: (frame)(pixel).
inline std::vector<std::vector<float>> series(const Camera& camera, double temperature,
                                              int frames) {
    std::vector<std::vector<float>> all;
    for (int f = 0; f < frames; ++f) {
        all.push_back(take(camera, even_flux(camera, temperature), 1000 + f, 0.0).measured);
    }
    return all;
}

inline std::vector<double> mean_of(const std::vector<std::vector<float>>& all) {
    std::vector<double> mean(all[0].size(), 0.0);
    for (const auto& frame : all) {
        for (std::size_t p = 0; p < mean.size(); ++p) {
            mean[p] += double(frame[p]) / double(all.size());
        }
    }
    return mean;
}

/// Of each pixel over time, the mean over pixels (root mean square).
inline double temporal_noise(const std::vector<std::vector<float>>& all) {
    const std::vector<double> mean = mean_of(all);
    double squares = 0.0;
    for (const auto& frame : all) {
        for (std::size_t p = 0; p < mean.size(); ++p) {
            squares += std::pow(double(frame[p]) - mean[p], 2);
        }
    }
    return std::sqrt(squares / (double(all.size() - 1) * double(mean.size())));
}

}  // namespace diurna::testing
