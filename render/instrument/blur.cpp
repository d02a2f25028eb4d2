#include "render/instrument/blur.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/radiation/planck.hpp"
#include "render/instrument/mtf.hpp"

namespace diurna {

namespace {

constexpr int table_size = 4096;
constexpr std::size_t most_wavelengths = 24;

struct Colour {
    double wavelength, share;  // [m]
};

/// The band's wavelengths, a few groups of nodes.
std::vector<Colour> colours_of(const Band& band) {
    const double middle_um = 0.5 * (band.from_um() + band.to_um());
    const double temperature = middle_um < 3.0 ? 5772.0 : 300.0;
    std::vector<Colour> colours;
    const std::size_t n = band.node_um.size(),
                      group = (n + most_wavelengths - 1) / most_wavelengths;
    double sum = 0.0;
    for (std::size_t from = 0; from < n; from += group) {
        double weight = 0.0, moment = 0.0;
        for (std::size_t i = from; i < std::min(n, from + group); ++i) {
            const double w = band.weight[i] * planck(band.node_um[i], temperature);
            weight += w;
            moment += w * band.node_um[i];
        }
        if (weight <= 0.0) continue;
        colours.push_back({moment / weight * 1e-6, weight});
        sum += weight;
    }
    for (Colour& colour : colours) colour.share /= sum;
    return colours;
}

double lens_mtf(const Instrument& instrument, const Colour& colour, double frequency,
                double focal_length) {
    const Blur& blur = instrument.blur;
    const double f_number = instrument.lens.f_number;
    const double nu = frequency * colour.wavelength * f_number;
    double mtf = 1.0;
    if (blur.diffraction) {
        mtf = defocused_mtf(nu, blur.defocus / (8.0 * f_number * f_number * colour.wavelength));
        if (blur.wavefront_error > 0.0) mtf *= wavefront_mtf(nu, blur.wavefront_error);
    }
    if (blur.turbulence_cn2 > 0.0) {
        mtf *= turbulence_mtf(
            frequency * focal_length, colour.wavelength,
            fried_length(colour.wavelength, blur.turbulence_cn2, blur.turbulence_range));
    }
    return mtf;
}

}  // namespace

SystemMtf::SystemMtf(const Instrument& instrument, const Band& band, double focal_length) {
    const std::vector<Colour> colours = colours_of(band);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Colour& colour : colours) shortest = std::min(shortest, colour.wavelength);
    const Detector& detector = instrument.detector;
    cut_off_ = instrument.blur.diffraction ? 1.0 / (shortest * instrument.lens.f_number)
                                           : std::numeric_limits<double>::infinity();
    const double end = std::min(cut_off_, 16.0 / detector.pitch);
    step_ = end / table_size;
    lens_.assign(table_size + 1, 0.0);
    for (int i = 0; i <= table_size; ++i) {
        for (const Colour& colour : colours) {
            lens_[std::size_t(i)] +=
                colour.share * lens_mtf(instrument, colour, i * step_, focal_length);
        }
    }
    jitter_ = instrument.blur.jitter * focal_length;
    drift_right_ = instrument.blur.drift.x() * focal_length;
    drift_down_ = instrument.blur.drift.y() * focal_length;
    diffusion_ = instrument.blur.diffusion_length;
    width_ = detector.pitch * std::sqrt(detector.fill);
}

double SystemMtf::lens_at(double frequency) const {
    const double place = frequency / step_;
    if (place >= table_size) return lens_.back();
    const auto cell = static_cast<std::size_t>(place);
    return std::lerp(lens_[cell], lens_[cell + 1], place - double(cell));
}

double SystemMtf::operator()(double right, double down) const {
    const double frequency = std::hypot(right, down);
    if (frequency >= cut_off_) return 0.0;
    // (T43) of docs/theory.md
    double mtf = lens_at(frequency) * sinc(right * width_) * sinc(down * width_);
    if (diffusion_ > 0.0) mtf *= diffusion_mtf(frequency, diffusion_);
    if (jitter_ > 0.0) mtf *= jitter_mtf(frequency, jitter_);
    if (drift_right_ != 0.0 || drift_down_ != 0.0) {
        mtf *= sinc(right * drift_right_ + down * drift_down_);
    }
    return mtf;
}

Oversampling oversampling_of(const Instrument& instrument, const SystemMtf& mtf) {
    const double pitch = instrument.detector.pitch;
    const auto left_at = [&](int times) {
        double most = 0.0;  // beyond half the rate to the rate itself, where it folds to zero
        for (int i = 0; i <= 16; ++i) {
            const double f = (0.5 + 0.5 * i / 16.0) * times / pitch;
            most = std::max({most, std::abs(mtf(f, 0.0)), std::abs(mtf(0.0, f))});
        }
        return most;
    };
    Oversampling found{instrument.oversampling, ""};
    if (found.times == 0) {
        found.times = 2;
        while (found.times < 6 && left_at(found.times) > 0.05) ++found.times;
    }
    const double left = left_at(found.times);
    found.why = fmt::format(
        "{} radiance samples per pixel and axis{}: frequencies above {:.3g} cycles/mm are aliased, "
        "the blur reduces them to {}; the pixels resolve {:.3g} cycles/mm",
        found.times, instrument.oversampling > 0 ? " (set in the scene)" : "",
        0.5e-3 * found.times / pitch,
        left < 0.005 ? std::string("less than 0.005") : fmt::format("{:.2f} or less", left),
        0.5e-3 / pitch);
    return found;
}

Convolution system_blur(const SystemMtf& mtf, double pitch, int times, int width, int height) {
    const double per_metre = times / pitch;
    return Convolution(
        width, height,
        [&](double right, double down) {
            return mtf(right * per_metre, down * per_metre) / (sinc(right) * sinc(down));
        },
        times % 2 == 0 ? 0.5 : 0.0);
}

}  // namespace diurna
