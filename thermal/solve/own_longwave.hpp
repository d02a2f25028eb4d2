#pragma once

#include <cstdint>
#include <vector>

#include "thermal/solve/network_object.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Longwave exchange between a target's own faces during its integration: the difference from the
/// state in which the neighbours' excess (SolveState::excess) was last computed. It is zero if the
/// integration repeats the previous one; exchange by way of other facets is left to the passes.
class OwnLongwave {
 public:
    /// Both must outlive it. Zero if facets do not exchange.
    OwnLongwave(const SolveState& solve, const NetworkObject& object);

    void begin();
    /// Moves on to an instant, with its facets' ends so warm [K]; adds one
    /// reflection.
    void at(std::size_t instant, const std::vector<double>& outer,
            const std::vector<double>& inner);
    /// [W m⁻²] on a facet's outer face, or its other side, in addition to the excess.
    double on(std::size_t n, bool inner) const {
        return arrives_.empty() ? 0.0 : arrives_[inner ? place_of_back_[n] : n];
    }

 private:
    const SolveState& solve_;
    std::vector<std::uint32_t> face_, end_of_;  // (place) the scene's facet, the network's
    std::vector<std::uint32_t> place_of_back_;  // (network's facet) its other side's
    std::vector<std::uint32_t> row_, from_;     // by place
    std::vector<float> factor_;
    std::vector<double> arrives_, leaves_;
};

}  // namespace diurna
