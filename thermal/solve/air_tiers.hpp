#pragma once

#include <cstdint>
#include <vector>

#include "materials/air/air_by_height.hpp"

namespace diurna {

/// Heights at which a solve computes air and sky; facets in between have interpolated values, so
/// that they change without a step from one facet to a higher one. With a lapse rate, tiers are at
/// most 200 m apart: pressure is off by a relative 1e-4, vapour by 7e-4 (4e-3 where saturation
/// begins); with a profile 50 m, and a kink of its temperature is off by a quarter of its change of
/// slope times that.
struct AirTiers {
    std::vector<double> height;      // (tier) [m] above the sea; one: the station's air for all
    std::vector<std::uint16_t> low;  // (facet) tier at its height or below; empty if there is one
    std::vector<float> share;        // (facet) fraction of the way to the next tier, 0 to 1

    bool flat() const { return height.size() == 1; }
    std::size_t size() const { return height.size(); }
};

/// facet_height  (facet) [m] above the sea; empty: all at the station. Where all are within a metre
///               of the station (6.5 mK), or there is no rule or it has the same air everywhere,
///               there is one tier and nothing is spent on heights.
///
/// edges  ascending [m], discontinuities of the light: additional tiers there
AirTiers air_tiers(const AirByHeight* rule, const std::vector<float>& facet_height,
                   const std::vector<double>& edges = {});

}  // namespace diurna
