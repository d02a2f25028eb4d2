#pragma once

#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// Parameters within bounds for which a model fits measurements best.
struct LeastSquares {
    /// The model's values at the measured points for given parameters; same length as `measured`.
    std::function<std::vector<double>(std::span<const double>)> model;
    std::vector<double> measured;
    std::vector<double> start, low, high;  // (parameter), start within low < high
    double difference = 0.005;             // of a parameter's range, for slopes of the model
};

struct FittedNumber {
    double value = 0.0;
    /// Standard deviation for independent errors: √(s² (JᵀJ)⁻¹), s² = Σr² / (n − p).
    double deviation = 0.0;
    /// 95 % interval by Student's t. Correlated neighbouring errors count as fewer: variance and
    /// degrees of freedom are those of n / (1 + 2 Σ r_k) values, r_k the correlation of residuals k
    /// apart, summed by Geyer's (1992) initial positive sequence. Not clipped at the bounds.
    double least = 0.0, most = 0.0;
    bool at_bound = false;  // and fixed there: its deviation is 0
    bool idle = false;      // the model does not depend on it
};

struct Fit {
    std::vector<FittedNumber> number;
    std::vector<std::vector<double>> correlation;  // (parameter, parameter); 0 for fixed ones
    std::vector<double> before, after;             // the model's values at start and result
    double rms_before = 0.0, rms = 0.0;
    double alike = 0.0;        // r_1 above, 0 if it is negative
    double independent = 0.0;  // n / (1 + 2 Σ r_k), n at most
    int passes = 0, runs = 0;  // runs of the model
    bool converged = false;
};

/// Levenberg's and Marquardt's method with slopes by central differences. Converged if the next
/// undamped step is less than a hundredth of a standard deviation, a tenth if no part of the step
/// improves the fit, or 1e-6 of all ranges.
/// Throws std::invalid_argument unless there are more values than parameters.
Fit fit(const LeastSquares& problem);

}  // namespace diurna
