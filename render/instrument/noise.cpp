#include "render/instrument/noise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double boltzmann = 1.380649e-23;           // [J/K]
constexpr double electron_charge = 1.602176634e-19;  // [C]
constexpr double netd_temperature = 300.0;           // [K]

double square(double x) { return x * x; }

bool is_photon(const Instrument& instrument) {
    return instrument.detector.kind == DetectorKind::photon;
}

double seconds_of(const Instrument& instrument) {
    return is_photon(instrument) ? instrument.detector.integration_time : 1.0;
}

double counting(double temperature, const Instrument& instrument, const Response& response) {
    if (!is_photon(instrument) || !instrument.detector.shot_noise) return 0.0;
    return signal_of(temperature, instrument, response);
}

}  // namespace

double reset_noise(double temperature, double capacitance) {
    return std::sqrt(boltzmann * temperature * capacitance) / electron_charge;
}

double noise_unit(const Detector& detector, const Response& response) {
    return detector.kind == DetectorKind::photon
               ? 1.0
               : 1e-3 * response.black_body_slope(netd_temperature);
}

double signal_of(double temperature, const Instrument& instrument, const Response& response) {
    const double dark = is_photon(instrument) ? instrument.detector.dark_current : 0.0;
    return seconds_of(instrument) *
           (response.black_body(temperature) + response.lens + response.beside + dark);
}

Noise noise_of(const Instrument& instrument, const Response& response) {
    const Detector& detector = instrument.detector;
    const double unit = noise_unit(detector, response);
    Noise noise{.pixel = unit * detector.read_noise,
                .flicker = unit * detector.flicker_noise,
                .row = unit * detector.row_noise,
                .column = unit * detector.column_noise,
                .frame = unit * detector.frame_noise};
    if (detector.capacitance > 0.0) {
        noise.pixel =
            std::hypot(noise.pixel, reset_noise(detector.temperature, detector.capacitance));
    }
    if (detector.netd > 0.0) {
        const double slope = seconds_of(instrument) * response.black_body_slope(netd_temperature);
        const double others =
            counting(netd_temperature, instrument, response) + square(noise.flicker);
        const double lacking = square(detector.netd * slope) - others;
        if (lacking < 0.0) {
            throw InputError("instrument " + instrument.name,
                             fmt::format("a NETD of {:.3g} mK is less than the {:.3g} mK of shot "
                                         "noise and 1/f noise alone",
                                         1e3 * detector.netd, 1e3 * std::sqrt(others) / slope),
                             detector.kind == DetectorKind::photon
                                 ? "raise detector.netd_mK, lower optics.f_number, or raise "
                                   "detector.integration_time_ms"
                                 : "raise detector.netd_mK, lower optics.f_number, or lower "
                                   "detector.flicker_noise");
        }
        noise.pixel = std::sqrt(lacking);
    }
    return noise;
}

double netd_at(double temperature, const Instrument& instrument, const Response& response,
               const Noise& noise, double step) {
    // (T44) of docs/theory.md
    const double variance = counting(temperature, instrument, response) + square(noise.pixel) +
                            square(noise.flicker) + square(step) / 12.0;
    return std::sqrt(variance) / (seconds_of(instrument) * response.black_body_slope(temperature));
}

}  // namespace diurna
