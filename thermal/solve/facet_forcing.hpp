#pragma once

#include <cmath>
#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Of rain and snow on level open ground, what falls on a facet: straight down, past what stands
/// above; on what is in flight nothing.
double rain_on(const SolveState& solve, std::size_t facet);

/// What one facet of a solve meets at any instant: sun, sky and neighbours straight between the
/// instants of the steps, but for the jumps of sunlight at shadows' edges.
class FacetForcing {
 public:
    /// weather  at the solve's instants; without it only sunlight, longwave and what falls are
    /// reported.
    ///          The solve must outlive this
    FacetForcing(const SolveState& solve, std::vector<Forcing> weather, const Block& block,
                 std::size_t lane);

    PointForcing operator()(Instant when) const;
    /// [W m⁻²] incident, at a share of step i.
    double sunlight(std::size_t i, double share) const;
    double longwave(std::size_t i, double share) const {
        return std::lerp(longwave_[i], longwave_[i + 1], share);
    }
    double behind(std::size_t i, double share) const {
        return std::lerp(behind_[i], behind_[i + 1], share);
    }
    /// Of rain on level open ground, what falls on it.
    double rain() const { return rain_share_; }

    /// Whether there is air behind it, and what its back absorbs of sun and longwave [W m⁻²].
    bool has_back() const { return !behind_.empty(); }
    /// Whether that back is a facet of the scene: a sheet's. In a closed mesh it is none.
    bool has_other_side() const { return other_side_; }
    double behind(Instant when) const;
    bool wet_behind() const { return wet_behind_; }

    /// Where its sunlight jumps, ascending.
    const std::vector<Instant>& edges() const { return edge_; }

 private:
    const SolveState& solve_;
    double measured_share_ = 0.0, rain_share_ = 1.0;
    std::vector<Forcing> weather_;             // (instant) at the facet's height
    std::vector<double> sunlight_, longwave_;  // (instant) [W m⁻²]
    std::vector<double> behind_{};             // (instant) absorbed by its back; empty: none
    bool wet_behind_ = false, other_side_ = false;
    std::vector<HeatJump> jump_;  // of step i from first_jump_[i] to first_jump_[i + 1]
    std::vector<std::size_t> first_jump_;
    std::vector<Instant> edge_;  // (jump)
};

}  // namespace diurna
