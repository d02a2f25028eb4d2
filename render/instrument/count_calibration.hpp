#pragma once

#include <string>
#include <vector>

#include "render/instrument/camera.hpp"

namespace diurna {

/// A camera's output for black bodies that fill its field, on the axis.
struct CalibrationPoint {
    double temperature;   // [K]
    double radiance;      // of the observer's band at the aperture [W m⁻² sr⁻¹]
    double signal;        // in integration_time, background included
    double counts;        // not rounded; may exceed the electronics' range
    double counts_per_K;  // slope: the signal transfer function (SiTF)
    double netd;          // [K] temporal noise of a pixel
};

/// Every `step` K from `low` to `high`.
std::vector<CalibrationPoint> calibration(const Camera& camera, const Band& band, double low,
                                          double high, double step);

/// The same as CSV, its header first.
std::string calibration_csv(const Camera& camera, const std::vector<CalibrationPoint>& points);

/// Black-body temperatures [K] of measured signals; 0 if there is none.
///
/// - time: of integration [s]; 1 for a bolometer
std::vector<float> measured_temperature(const Camera& camera, const std::vector<float>& measured,
                                        double time);

}  // namespace diurna
