#include "thermal/solve/air_tiers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diurna {

namespace {

/// Adds those of the edges that lie between the heights; whether there are any.
bool add_edges(const std::vector<double>& edges, std::vector<double>& heights) {
    const double bottom = heights.front(), top = heights.back();
    const std::size_t before = heights.size();
    for (const double edge : edges) {
        if (edge > bottom && edge < top) heights.push_back(edge);
    }
    std::sort(heights.begin(), heights.end());
    return heights.size() > before;
}

std::pair<std::uint16_t, double> place_of_even(double z, double bottom, double span, double gaps) {
    const double place = (z - bottom) / span * gaps;
    const double low = std::clamp(std::floor(place), 0.0, gaps - 1.0);
    return {static_cast<std::uint16_t>(low), std::clamp(place - low, 0.0, 1.0)};
}

std::pair<std::uint16_t, double> place_in(const std::vector<double>& heights, double z) {
    const auto next = std::upper_bound(heights.begin() + 1, heights.end() - 1, z);
    const auto low = next - 1;
    return {static_cast<std::uint16_t>(low - heights.begin()),
            std::clamp((z - *low) / std::max(1e-6, *next - *low), 0.0, 1.0)};
}

}  // namespace

AirTiers air_tiers(const AirByHeight* rule_or_none, const std::vector<float>& facet_height,
                   const std::vector<double>& edges) {
    constexpr double level_ground = 1.0, most_tiers = 1000.0;
    AirTiers tiers{.height = {0.0}, .low = {}, .share = {}};
    if (!rule_or_none || rule_or_none->same_everywhere() || facet_height.empty()) return tiers;
    const AirByHeight& rule = *rule_or_none;
    const double spacing = rule.profile ? 50.0 : 200.0;
    const auto [least, most] = std::minmax_element(facet_height.begin(), facet_height.end());
    const double bottom = *least, top = *most;
    if (top <= rule.station + level_ground && bottom >= rule.station - level_ground) return tiers;
    const double span = std::max(top - bottom, 1.0);
    const double gaps = std::clamp(std::ceil(span / spacing), 1.0, most_tiers);
    tiers.height.clear();
    for (double i = 0.0; i <= gaps; ++i) tiers.height.push_back(bottom + span * i / gaps);
    const bool even = !add_edges(edges, tiers.height);
    for (const float z : facet_height) {
        const auto [low, share] =
            even ? place_of_even(double(z), bottom, span, gaps) : place_in(tiers.height, double(z));
        tiers.low.push_back(low);
        tiers.share.push_back(float(share));
    }
    return tiers;
}

}  // namespace diurna
