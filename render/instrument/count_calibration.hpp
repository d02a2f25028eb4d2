#pragma once

#include <string>
#include <vector>

#include "render/instrument/camera.hpp"

namespace diurna {

/// What a camera shows of black bodies that fill its field, on the axis.
struct CalibrationPoint {
    double temperature;   // [K]
    double radiance;      // of the observer's band at the aperture [W m⁻² sr⁻¹]
    double signal;        // in integration_time, background included
    double counts;        // not rounded; may be beyond what the electronics show
    double counts_per_K;  // slope: the signal transfer function (SiTF)
    double netd;          // [K] a pixel's temporal noise
};

/// Every `step` K from `low` to `high`.
std::vector<CalibrationPoint> calibration(const Camera& camera, const Band& band, double low,
                                          double high, double step);

/// The same as CSV, its header first.
std::string calibration_csv(const Camera& camera, const std::vector<CalibrationPoint>& points);

/// Temperatures [K] of the black bodies that measured signals look like; 0 where there is none.
///
/// - time: of integration [s]; 1 of a bolometer
std::vector<float> measured_temperature(const Camera& camera, const std::vector<float>& measured,
                                        double time);

}  // namespace diurna
