#include "render/detection/task_metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "render/detection/eye.hpp"
#include "render/instrument/mtf.hpp"

namespace diurna {

namespace {

constexpr double noise_rates =
    16.0;  // of the pixels; beyond, a display leaves 0.6 % of white noise
constexpr int noise_steps = 2048;

/// What noise an observer has from a display: (step) the power that display and eye pass.
class PassedNoise {
 public:
    PassedNoise(const Imager& imager, const Viewing& viewing)
        : step_(noise_rates / imager.pixel / noise_steps) {
        const double pupil = pupil_diameter_mm(viewing.luminance);
        for (int i = 0; i < noise_steps; ++i) {
            const double f = frequency(i);
            const double shown = sinc(f * imager.pixel) * eye_mtf(f / viewing.magnification, pupil);
            passed_.push_back(shown * shown);
        }
    }
    /// ∫ [display · eye]² df over both signs.
    double all() const {
        return 2.0 * step_ * std::accumulate(passed_.begin(), passed_.end(), 0.0);
    }
    /// The same of what counts in seeing a wave.
    double about(double signal) const {
        double sum = 0.0;
        for (int i = 0; i < noise_steps; ++i) {
            const double channel = noise_channel(frequency(i), signal);
            sum += channel * channel * passed_[std::size_t(i)];
        }
        return 2.0 * step_ * sum;
    }

 private:
    double frequency(int i) const { return (i + 0.5) * step_; }

    double step_;
    std::vector<double> passed_;
};

double integral_along(double contrast, const std::vector<double>& threshold, double step) {
    double sum = 0.0;
    for (const double t : threshold) sum += contrast > t ? std::sqrt(contrast / t) : 0.0;
    return sum * step;
}

}  // namespace

SystemThreshold system_threshold(const Imager& imager, const Viewing& viewing, int steps) {
    const PassedNoise noise(imager, viewing);
    const double density = imager.netd * imager.netd * imager.pixel * imager.pixel /
                           imager.frame_rate;  // [K² mrad² s]
    const double scale = noise_sensitivity * noise_sensitivity * density /
                         (viewing.scene_contrast * viewing.scene_contrast) * noise.all();
    SystemThreshold found{.step = imager.finest() / steps, .right = {}, .down = {}};
    for (int i = 0; i < steps; ++i) {
        const double f = (i + 0.5) * found.step;
        const double eye =
            contrast_threshold(f / viewing.magnification, viewing.luminance, viewing.display_deg) *
            std::sqrt(1.0 + scale * noise.about(f));
        const double display = sinc(f * imager.pixel);
        const auto through = [&](double mtf) {
            return mtf > 0.0 ? eye / (mtf * display) : std::numeric_limits<double>::infinity();
        };
        found.right.push_back(through(imager.mtf_right(f)));
        found.down.push_back(through(imager.mtf_down(f)));
    }
    return found;
}

double task_integral(double contrast, const SystemThreshold& threshold) {
    return std::sqrt(integral_along(contrast, threshold.right, threshold.step) *
                     integral_along(contrast, threshold.down, threshold.step));
}

double task_metric(double difference, double size, double range, const SystemThreshold& threshold,
                   const Viewing& viewing) {
    const double contrast = std::min(1.0, 0.5 * difference / viewing.scene_contrast);
    // (T47) of docs/theory.md
    return 1000.0 * size / range * task_integral(contrast, threshold);
}

}  // namespace diurna
