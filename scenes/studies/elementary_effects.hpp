#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diurna {

/// Points of a screening by elementary effects (Morris, Technometrics 33, 161, 1991): in each of
/// the trajectories, neighbours differ in only one input, by `step`; each input changes once.
struct MorrisDesign {
    std::size_t inputs = 0, trajectories = 0;
    double step = 0.0;                         // p / (2 (p − 1)) of p levels
    std::vector<std::vector<double>> point{};  // (trajectory · (inputs + 1) + k) (input), 0 to 1
    std::vector<std::size_t> changed{};        // (trajectory · inputs + k) between points k, k + 1
};

/// Starts and orders depend only on `seed`, trajectory and input: the first trajectories of a
/// longer design are those of a shorter one.
///
/// - levels: even, 2 or more; all equally likely
MorrisDesign morris_design(std::size_t inputs, std::size_t trajectories, int levels,
                           std::uint64_t seed);

/// Effect of one input on a result, in units of the result for the input's whole range.
struct ElementaryEffect {
    double mean = 0.0;        // mu: 0 also where effects of both signs cancel
    double mean_size = 0.0;   // mu*, of absolute values (Campolongo et al. 2007)
    double deviation = 0.0;   // sigma, of a sample: 0 if the result is linear in this input
    double size_error = 0.0;  // standard error of mean_size
    std::size_t count = 0;    // trajectories used: both results are numbers
};

/// - result: (point of the design), NaN if undefined
std::vector<ElementaryEffect> elementary_effects(const MorrisDesign& design,
                                                 const std::vector<double>& result);

}  // namespace diurna
