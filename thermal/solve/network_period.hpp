#pragma once

#include <vector>

#include "thermal/network/network_step.hpp"

namespace diurna {

/// The start of a period from a trial start and its result. To first order a span P changes the
/// error e of a start into M e, M = exp(−λ P) for each decay mode of the network; the missing part
/// at its end is M (1 − M)⁻¹ of the change. That is about 1 / (λP (1 + λP / 2)): two solves of the
/// network under its mean slopes, steady and with a step of P / 2. The remaining error is at most a
/// twelfth of e, at λP of 2 to 3, and a thousandth for decay over weeks: no other start is needed,
/// so neighbours may change from span to span.
class NetworkPeriod {
 public:
    /// The network must outlive it.
    explicit NetworkPeriod(const HeatNetwork& network);

    void begin();
    /// Adds the slopes of a step.
    void add(const NetworkStepper& stepper);
    /// start, end  [K] nodes, then lumps
    /// span        [s]
    std::vector<double> next(const std::vector<double>& start, const std::vector<double>& end,
                             double span);

 private:
    void heat_of(const std::vector<double>& change, double over,
                 NetworkSystem::Residual& heat) const;

    const HeatNetwork& network_;
    NetworkSystem system_;
    double steps_ = 0.0;
    std::vector<double> outer_, inner_, to_star_;  // (facet) sums over steps of slopes
};

}  // namespace diurna
