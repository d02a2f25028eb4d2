#pragma once

#include <Eigen/Core>
#include <vector>

#include "thermal/network/network_system.hpp"

namespace diurna {

/// The start of a period from those tried so far and what came of them: Anderson's mixing of the
/// last few (1965), which settles what is slower than the period.
class NetworkPeriod {
 public:
    std::vector<double> next(const std::vector<double>& start, const std::vector<double>& end);

 private:
    std::vector<Eigen::VectorXd> start_, end_;
};

/// Columns that nothing but their outer face leads to, such as ground below a contact: what lies
/// deep takes years to follow, but in the mean of a period heat passes through as in a steady
/// column. So they are moved there at once.
class DeepColumns {
 public:
    /// Must outlive it.
    DeepColumns(const HeatNetwork& network, const NetworkSystem& system);

    void begin();
    /// A state at the end of one of equal steps.
    void add(const NetworkState& state);
    /// The period's end, node by node, to where another better starts.
    void settle(std::vector<double>& end) const;

 private:
    struct Deep {
        std::size_t facet, node;
        std::vector<double> sum;  // (node) over steps
    };
    const HeatNetwork& network_;
    std::vector<Deep> deep_;
    double steps_ = 0.0;
};

}  // namespace diurna
