#pragma once

#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// What one facet of a solve meets at any instant: sun, sky and neighbours straight between the
/// instants of the steps, but for the jumps of sunlight at shadows' edges.
class FacetForcing {
 public:
    /// weather  at the solve's instants; the solve must outlive this
    FacetForcing(const SolveState& solve, std::vector<Forcing> weather, const Block& block,
                 std::size_t lane);

    PointForcing operator()(Instant when) const;

    /// Whether it is a sheet's front, and what its back absorbs of sun and longwave [W m⁻²].
    bool has_back() const { return !behind_.empty(); }
    double behind(Instant when) const;
    bool wet_behind() const { return wet_behind_; }

    /// Where its sunlight jumps, ascending.
    const std::vector<Instant>& edges() const { return edge_; }

 private:
    const SolveState& solve_;
    double measured_share_ = 0.0;
    std::vector<Forcing> weather_;             // (instant) at the facet's height
    std::vector<double> sunlight_, longwave_;  // (instant) [W m⁻²]
    std::vector<double> behind_{};             // (instant) absorbed by its back; empty: none
    bool wet_behind_ = false;
    std::vector<HeatJump> jump_;  // of step i from first_jump_[i] to first_jump_[i + 1]
    std::vector<std::size_t> first_jump_;
    std::vector<Instant> edge_;  // (jump)
};

}  // namespace diurna
