#include "thermal/solve/air_tiers.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

AirTiers air_tiers(const AirByHeight* rule_or_none, const std::vector<float>& facet_height) {
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
    for (const float z : facet_height) {
        const double place = (double(z) - bottom) / span * gaps;
        const double low = std::clamp(std::floor(place), 0.0, gaps - 1.0);
        tiers.low.push_back(static_cast<std::uint16_t>(low));
        tiers.share.push_back(float(std::clamp(place - low, 0.0, 1.0)));
    }
    return tiers;
}

}  // namespace diurna
