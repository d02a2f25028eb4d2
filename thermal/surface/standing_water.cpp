#include "thermal/surface/standing_water.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/column/column.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/ground_and_leaves.hpp"

namespace diurna {

double apart(const Standing& a, const Standing& b) {
    return std::abs(a.water - b.water) + std::abs(a.frost - b.frost);
}

double snow_share(double air_temperature) {
    return std::clamp(0.5 * (zero_celsius + 2.0 - air_temperature), 0.0, 1.0);
}

double aged_albedo(const AgeingAlbedo& law, double before, bool melting, double fallen,
                   double step) {
    constexpr double day = 86400.0, dry_loss = 0.008, melting_rate = 0.24, renewing = 10.0;
    const double over = std::max(0.0, before - law.old);
    const double left = melting ? over * std::exp(-melting_rate * step / day)
                                : std::max(0.0, over - dry_loss * step / day);
    const double aged = std::min(before, law.old) + left;
    return std::min(law.fresh, aged + fallen / renewing * (law.fresh - law.old));
}

StoreFlows store_flows(const std::array<SurfaceConditions, 2>& conditions,
                       const std::array<double, 2>& surface, bool gentle, double step) {
    StoreFlows flows;
    for (std::size_t k = gentle ? 1 : 0; k < 2; ++k) {
        const SurfaceConditions& c = conditions[k];
        const double weight = gentle ? step : step * stage_weight[k];
        const SurfaceTerms terms = surface_terms(c, surface[k]);
        const double gain =
            weight * terms.wet_evaporation / heat_of_vapour(c.air.air_temperature, terms.leaf);
        flows.free += weight * terms.wet_evaporation / step;
        flows.melt -= weight * terms.frost_melt;
        if (gain < 0.0) {
            flows.evaporated -= c.wet_share * gain;
        } else if (terms.leaf < zero_celsius) {
            flows.hoar += gain;
        } else {
            flows.dew += gain;
        }
    }
    const double fallen =
        std::lerp(conditions[0].rain_mm_h, conditions[1].rain_mm_h, sdirk_gamma) * step / 3600.0;
    flows.snow = snow_share(conditions[1].air.air_temperature) * fallen;
    flows.rain = fallen - flows.snow;
    return flows;
}

Standing stored_after(const Standing& before, const StoreFlows& flows, double capacity_mm) {
    const double melted = std::clamp(flows.melt / heat_of_fusion, -before.water - flows.rain,
                                     before.frost + flows.snow);
    Standing after{.water = before.water + flows.dew + flows.rain + melted,
                   .frost = before.frost + flows.hoar + flows.snow - melted};
    const double total = after.water + after.frost;
    if (total > 0.0) {
        const double left = std::max(0.0, total - flows.evaporated) / total;
        after.water *= left;
        after.frost *= left;
    }
    const double over = after.water + after.frost - capacity_mm;
    if (over > 0.0) {
        after.water -= std::min(over, after.water);
        after.frost = std::min(after.frost, capacity_mm);
    }
    return after;
}

}  // namespace diurna
