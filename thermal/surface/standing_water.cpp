#include "thermal/surface/standing_water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "thermal/surface/frost.hpp"

namespace diurna {

namespace {

constexpr double pores = 0.05;  // [kg kg⁻¹] of snow

}  // namespace

double apart(const Standing& a, const Standing& b) {
    return std::abs(a.water - b.water) + std::abs(a.frost - b.frost);
}

double snow_share(double air_temperature) {
    return std::clamp(0.5 * (zero_celsius + 2.0 - air_temperature), 0.0, 1.0);
}

double aged_albedo(const AgeingAlbedo& law, double before, bool melting, double fallen,
                   double step) {
    constexpr double day = 86400.0, dry_loss = 0.008, melting_rate = 0.24, renewing = 10.0;
    // (T15) of docs/theory.md
    const double over = std::max(0.0, before - law.old);
    const double left = melting ? over * std::exp(-melting_rate * step / day)
                                : std::max(0.0, over - dry_loss * step / day);
    const double aged = std::min(before, law.old) + left;
    return std::min(law.fresh, aged + fallen / renewing * (law.fresh - law.old));
}

StoreCapacity store_capacity(const WaterStore& store, double up_cosine) {
    constexpr double film = 0.05;  // [mm]
    StoreCapacity capacity{.water_mm = store.capacity_mm, .caught = 1.0};
    const double up = std::clamp(up_cosine, 0.0, 1.0);
    if (!store.leaves) {
        const double rise = std::sqrt(1.0 - up * up) / std::max(up, 1e-6);
        const double kept = std::pow(std::max(1.0, 100.0 * rise), -0.49);
        capacity.water_mm = std::max(std::min(film, store.capacity_mm), kept * store.capacity_mm);
    }
    capacity.caught = std::clamp(2.0 - std::acos(up) / (std::numbers::pi / 6.0), 0.0, 1.0);
    return capacity;
}

double rain_share(double up_cosine, double open_above) {
    return std::max(0.0, up_cosine) * open_above;
}

SnowCover snow_cover(double frost, double roughness_length) {
    constexpr double density = 200.0, conductivity = 0.10, stiffest = 1e6;
    if (frost < 1e-6) return {};
    // (T14) of docs/theory.md
    const double depth = frost / density;
    const double share = depth / (depth + 5.0 * roughness_length);
    return {share, std::min(stiffest, conductivity / (depth * share)),
            thin_phase_film * (1.0 + 39.0 * share)};
}

double mean_wet_share(double held, double rain, double drying, double capacity) {
    if (capacity <= 0.0) return 0.0;
    // (T13) of docs/theory.md
    const double r = rain / capacity, e = std::max(drying / capacity, 1e-9);
    double x = held / capacity, left = 1.0, wet = 0.0;  // of the step
    if (x >= 1.0) {
        if (r >= e || x - 1.0 >= e - r) return 1.0;
        wet = (x - 1.0) / (e - r);
        left -= wet;
        x = 1.0;
    }
    // x goes from here to r / e; if that is beyond 1, it stays there.
    double until = left;
    if (r > e) until = std::min(left, std::log((r - e * x) / (r - e)) / e);
    const double gone = -std::expm1(-e * until) / e;
    return std::min(1.0, wet + (until - gone) * (r / e) + x * gone + (left - until));
}

Lying lying_over(const Standing& begin, const StoreCapacity& capacity, const StoreRates& rates,
                 double rain, double snow, double step) {
    Lying lying{.middle = begin, .wet_share = 0.0, .rain = rain, .snow = snow};
    const double caught = capacity.caught * snow, held = begin.water + begin.frost;
    const double drying = std::max(0.0, rates.drying) * step;
    lying.wet_share = mean_wet_share(held, rain + caught, drying, capacity.water_mm);
    const double dried = held > 0.0 ? std::min(1.0, 0.5 * lying.wet_share * drying / held) : 0.0;
    Standing& middle = lying.middle;
    middle.water += 0.5 * rain - dried * begin.water;
    middle.frost += 0.5 * caught - dried * begin.frost;
    const double melted = std::clamp(0.5 * rates.melting * step, -middle.water, middle.frost);
    middle.frost -= melted;
    middle.water = std::min(middle.water + melted, capacity.water_mm + pores * middle.frost);
    return lying;
}

StoreRates middle_of(const StoreRates& a, const StoreRates& b) {
    return {0.5 * (a.drying + b.drying), 0.5 * (a.melting + b.melting)};
}

bool alike(const Lying& a, const Lying& b, const StoreCapacity& capacity) {
    constexpr double near = 1e-3;
    return std::abs(a.wet_share - b.wet_share) <= near &&
           apart(a.middle, b.middle) <= near * capacity.water_mm;
}

StoreRates StoreFlows::rates(double step) const {
    return {drying / step, melt / (heat_of_fusion * step)};
}

void add_stage(const StoreStage& s, StoreFlows& flows) {
    const double gain = s.weight * s.wet_latent / heat_of_vapour(s.air_temperature, s.surface);
    flows.melt -= s.weight * s.frost_melt;
    if (gain < 0.0) {
        flows.evaporated -= s.wet_share * gain;
        flows.drying -= gain;
    } else if (s.surface < zero_celsius) {
        flows.hoar += gain;
    } else {
        flows.dew += gain;
    }
}

double WaterCount::open(const Standing& before, const Standing& now) const {
    return fallen + condensed - evaporated - run_off -
           ((now.water - before.water) + (now.frost - before.frost));
}

Standing stored_after(const Standing& before, const StoreFlows& flows,
                      const StoreCapacity& capacity, WaterCount& count) {
    constexpr double most_snow = 1000.0;  // [mm]
    const double caught = capacity.caught * flows.snow;
    const double melted =
        std::clamp(flows.melt / heat_of_fusion, -before.water - flows.rain, before.frost + caught);
    Standing after{.water = before.water + flows.dew + flows.rain + melted,
                   .frost = before.frost + flows.hoar + caught - melted};
    const double total = after.water + after.frost;
    double evaporated = 0.0;
    if (total > 0.0) {
        evaporated = std::min(flows.evaporated, total);
        after.water -= evaporated * (after.water / total);
        after.frost -= evaporated * (after.frost / total);
    }
    const double snow_over = std::max(0.0, after.frost - most_snow);
    const double over =
        std::max(0.0, after.water - capacity.water_mm - pores * (after.frost - snow_over));
    after.water -= over;
    after.frost -= snow_over;
    count.fallen += flows.rain + flows.snow;
    count.condensed += flows.dew + flows.hoar;
    count.evaporated += evaporated;
    count.run_off += over + snow_over + (flows.snow - caught);
    return after;
}

}  // namespace diurna
