#pragma once

#include <cmath>
#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Share of rain and snow on level open ground that falls on a facet: vertically, reduced by what
/// is above it; zero for facets in flight.
double rain_on(const SolveState& solve, std::size_t facet);

/// Inputs of one facet of a solve at any instant: sun, sky and neighbours, linear between the
/// instants of the steps, except for the jumps of sunlight at shadows' edges.
class FacetForcing {
 public:
    /// weather  at the solve's instants; without it only sunlight, longwave and precipitation are
    ///          available. The solve must outlive this
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
    /// Share of rain on level open ground that falls on it.
    double rain() const { return rain_share_; }

    /// Whether it has a back in air, and the sun and longwave absorbed by it [W m⁻²].
    bool has_back() const { return !behind_.empty(); }
    /// Whether that back is a facet of the scene: a sheet's. In a closed mesh it is not.
    bool has_other_side() const { return other_side_; }
    double behind(Instant when) const;
    bool wet_behind() const { return wet_behind_; }

    /// Instants of its sunlight's jumps, ascending.
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
