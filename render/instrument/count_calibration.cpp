#include "render/instrument/count_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// A count, without the rounding error of a zero.
double no_rounding(double count) { return std::abs(count) < 1e-9 ? 0.0 : count; }

}  // namespace

std::vector<CalibrationPoint> calibration(const Camera& camera, const Band& band, double low,
                                          double high, double step) {
    const Instrument& instrument = camera.instrument;
    const CountScale scale = count_scale(camera);
    const double time = instrument.detector.kind == DetectorKind::photon
                            ? instrument.detector.integration_time
                            : 1.0;
    std::vector<CalibrationPoint> points;
    const int last = static_cast<int>(std::floor((high - low) / step + 1e-9));
    for (int i = 0; i <= last; ++i) {
        const double temperature = low + i * step;
        const double signal = signal_of(temperature, instrument, camera.response);
        points.push_back({.temperature = temperature,
                          .radiance = band_radiance(band, temperature),
                          .signal = signal,
                          .counts = scale.counts(signal),
                          .counts_per_K = scale.per_signal * time *
                                          camera.response.black_body_slope(temperature),
                          .netd = netd_at(temperature, instrument, camera.response, camera.noise,
                                          1.0 / scale.per_signal)});
    }
    return points;
}

std::string calibration_csv(const Camera& camera, const std::vector<CalibrationPoint>& points) {
    std::string text =
        fmt::format("temperature_K,radiance_W_m2_sr,signal_{},counts,counts_per_K,netd_mK\n",
                    camera.instrument.detector.kind == DetectorKind::photon ? "electrons" : "pW");
    for (const CalibrationPoint& p : points) {
        text +=
            fmt::format("{:g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", p.temperature, p.radiance,
                        p.signal, no_rounding(p.counts), no_rounding(p.counts_per_K), 1e3 * p.netd);
    }
    return text;
}

std::vector<float> measured_temperature(const Camera& camera, const std::vector<float>& measured,
                                        double time) {
    const Response& response = camera.response;
    const bool photon = camera.instrument.detector.kind == DetectorKind::photon;
    const double background =
        response.lens + response.beside + (photon ? camera.instrument.detector.dark_current : 0.0);
    // Radiances are inverted on a scale over their range; a few thousand places, straight between.
    std::vector<double> flux;
    flux.reserve(measured.size());
    double low = 1e300, high = 0.0;
    for (const float signal : measured) {
        const double radiance = (double{signal} / time - background) / response.per_radiance;
        flux.push_back(radiance);
        if (radiance > 0.0) low = std::min(low, radiance);
        high = std::max(high, radiance);
    }
    std::vector<float> found(measured.size(), 0.0f);
    if (high <= 0.0) return found;
    constexpr int places = 4096;
    const double from = std::log(std::max(low, 1e-9 * high)),
                 step = (std::log(high) - from) / places;
    std::vector<double> table;
    for (int i = 0; i <= places; ++i) {
        table.push_back(brightness_temperature(response.scene, std::exp(from + i * step)));
    }
    for (std::size_t p = 0; p < flux.size(); ++p) {
        if (flux[p] <= 0.0) continue;
        const double place =
            step > 0.0 ? std::clamp((std::log(flux[p]) - from) / step, 0.0, double(places)) : 0.0;
        const int cell = std::min(int(place), places - 1);
        found[p] = static_cast<float>(
            std::lerp(table[std::size_t(cell)], table[std::size_t(cell) + 1], place - cell));
    }
    return found;
}

}  // namespace diurna
