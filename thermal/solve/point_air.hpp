#pragma once

#include <map>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Air and its film over one kind of surface at a solve's instants, by slices of eight metres of
/// height, each with the air at its middle: 26 mK off at its ends.
class PointAir {
 public:
    /// All arguments must outlive this.
    ///
    /// weather    at the solve's instants
    /// sheltered  ground with a reduced wind
    PointAir(const SolveState& solve, const Kind& kind, const std::vector<Forcing>& weather,
             bool sheltered)
        : solve_(solve), kind_(kind), weather_(weather), sheltered_(sheltered) {}

    /// (instant)
    const std::vector<AirFilm>& over(std::size_t facet);

 private:
    const SolveState& solve_;
    const Kind& kind_;
    const std::vector<Forcing>& weather_;
    bool sheltered_;
    std::map<long, std::vector<AirFilm>> slice_{};
};

}  // namespace diurna
