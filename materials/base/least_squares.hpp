#pragma once

#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// Numbers within bounds by which a model comes closest to what was measured.
struct LeastSquares {
    /// What the model says where it was measured, for such numbers; as many as `measured`.
    std::function<std::vector<double>(std::span<const double>)> model;
    std::vector<double> measured;
    std::vector<double> start, low, high;  // (number), start within low < high
    double difference = 0.005;             // of a number's range, in slopes of the model
};

struct FittedNumber {
    double value = 0.0;
    /// Its standard deviation where errors are independent: √(s² (JᵀJ)⁻¹), s² = Σr² / (n − p).
    double deviation = 0.0;
    /// 95 % interval by Student's t. Neighbouring errors that are alike count as fewer: variance
    /// and freedom are those of n / (1 + 2 Σ r_k) values, r_k the correlation of residuals k apart,
    /// summed by Geyer's (1992) initial positive sequence. Not cut off at the bounds.
    double least = 0.0, most = 0.0;
    bool at_bound = false;  // and held there: its deviation is none (0)
    bool idle = false;      // the model does not depend on it
};

struct Fit {
    std::vector<FittedNumber> number;
    std::vector<std::vector<double>> correlation;  // (number, number); 0 beside held ones
    std::vector<double> before, after;             // the model with start and with the result
    double rms_before = 0.0, rms = 0.0;
    double alike = 0.0;        // r_1 above, 0 where it is negative
    double independent = 0.0;  // n / (1 + 2 Σ r_k), n at most
    int passes = 0, runs = 0;  // runs of the model
    bool converged = false;
};

/// Levenberg's and Marquardt's method with slopes by central differences. It has converged where
/// the next step, undamped, is less than a hundredth of a standard deviation, a tenth if no part of
/// it betters the fit, or 1e-6 of all ranges.
/// Throws std::invalid_argument where there are not more values than numbers.
Fit fit(const LeastSquares& problem);

}  // namespace diurna
