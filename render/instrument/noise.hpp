#pragma once

#include "render/instrument/instrument.hpp"
#include "render/instrument/response.hpp"

namespace diurna {

/// Temporal noise of a detector in its signal's unit (electrons, pW), rms.
struct Noise {
    double pixel = 0.0;  // of each pixel, besides photon noise: read, kTC
    double flicker = 0.0;
    double row = 0.0, column = 0.0, frame = 0.0;
};

/// kTC noise of a node that is reset [electrons]: √(k T C)/e.
double reset_noise(double temperature, double capacitance);

/// The unit of Detector's noises in the signal: an electron, or 1 mK at 300 K.
double noise_unit(const Detector& detector, const Response& response);

/// If Detector::netd is given, `pixel` is set to reach it at 300 K; throws InputError if photon
/// noise alone exceeds it.
Noise noise_of(const Instrument& instrument, const Response& response);

/// Noise equivalent temperature difference [K] for a black body: a pixel's temporal noise, photon
/// noise and quantisation included, over the signal's slope.
///
/// - step: of the counts in the signal's unit; 0: none
double netd_at(double temperature, const Instrument& instrument, const Response& response,
               const Noise& noise, double step = 0.0);

/// Signal of a black body on the axis in integration_time, background and dark current included.
double signal_of(double temperature, const Instrument& instrument, const Response& response);

}  // namespace diurna
