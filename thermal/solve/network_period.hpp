#pragma once

#include <vector>

#include "thermal/network/network_step.hpp"

namespace diurna {

/// The start of a period from one that was tried and what came of it. To first order a span P takes
/// what a start is off by, e, to M e, M = exp(−λ P) along each way in which the network cools; what
/// is missing at its end is M (1 − M)⁻¹ of the change. That is about 1 / (λP (1 + λP / 2)): two
/// solves of the network under its mean slopes, at rest and with a step of P / 2. What is left is
/// a twelfth of e at most, at λP of 2 to 3, and a thousandth where it takes weeks: no other start
/// has to be known, so that neighbours may change from span to span.
class NetworkPeriod {
 public:
    /// Must outlive it.
    explicit NetworkPeriod(const HeatNetwork& network);

    void begin();
    /// A step has been taken.
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
