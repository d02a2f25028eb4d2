#pragma once

#include <cstdint>
#include <vector>

#include "thermal/solve/network_object.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// The longwave that a target's faces send one another, while it marches: what they send otherwise
/// than when their neighbours' excess (SolveState::excess) was last found. A march that led where
/// the one before did finds nothing; what is left to the passes is what goes by way of others.
class OwnLongwave {
 public:
    /// Both must outlive it. Nothing where facets do not exchange.
    OwnLongwave(const SolveState& solve, const NetworkObject& object);

    void begin();
    /// Follows on to an instant, at which a facet's ends are so warm [K], one reflection further.
    void at(std::size_t instant, const std::vector<double>& outer,
            const std::vector<double>& inner);
    /// [W m⁻²] that falls on a facet's outer face, or its other side, beyond the excess.
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
