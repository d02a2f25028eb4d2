#include "thermal/steppers/lying_lanes.hpp"

#include <algorithm>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t lying_width = enthalpy_lanes;

}  // namespace

double albedo_of(const EnthalpyBatch& batch, std::size_t l, double wet, double cover, double snow) {
    const ThermalSurface& surface = *batch.surface;
    if (surface.snow_albedo) return batch.snow_albedo[l];
    double albedo = surface.albedo;
    if (surface.store.wet_albedo >= 0.0) albedo += wet * (surface.store.wet_albedo - albedo);
    return albedo + cover * (snow - albedo - surface.solar_transmittance);
}

Covered begin_lying(const EnthalpyForcing& f, const EnthalpyBatch& batch) {
    Covered covered;
    covered.rates = batch.rates;
    for (std::size_t l = 0; l < lying_width; ++l) {
        Lying& lying = covered.lying[l];
        lying.middle = batch.standing[l];
        const double fallen =
            batch.rain_share[l] * std::max(0.0, f.rain_mm_h[l]) * f.duration[l] / 3600.0;
        lying.snow = fallen > 0.0 ? snow_share(f.air_temperature[l]) * fallen : 0.0;
        lying.rain = fallen - lying.snow;
        covered.bare[l] = fallen == 0.0 && lying.middle.water == 0.0 && lying.middle.frost == 0.0;
    }
    return covered;
}

void lie(const EnthalpyBatch& batch, const EnthalpyForcing& f, Covered& covered) {
    const ThermalSurface& surface = *batch.surface;
    EnthalpyBatch::Met& met = covered.met;
    met.covered = false;
    for (std::size_t l = 0; l < lying_width; ++l) {
        if (covered.bare[l]) {
            met.wet_share[l] = met.frost_heat[l] = met.water_heat[l] = 0.0;
            met.cover[l] = no_snow;
            met.phase_film[l] = thin_phase_film;
            met.albedo[l] = albedo_of(batch, l, 0.0, 0.0, 0.0);
            continue;
        }
        const Standing& at = batch.standing[l];
        const StoreCapacity& capacity = batch.capacity[l];
        const double step = f.duration[l];
        Lying& lying = covered.lying[l];
        if (batch.stores()) {
            lying = lying_over(at, capacity, covered.rates[l], lying.rain, lying.snow, step);
        }
        const SnowCover snow = snow_lies(surface)
                                   ? snow_cover(lying.middle.frost, surface.roughness_length)
                                   : SnowCover{};
        const double wet =
            capacity.any() ? std::min(1.0, lying.middle.water / capacity.water_mm) : 0.0;
        met.wet_share[l] = lying.wet_share;
        met.cover[l] = snow.conductance > 0.0 ? snow.conductance : no_snow;
        met.covered = met.covered || snow.conductance > 0.0;
        met.phase_film[l] = snow.phase_film;
        met.frost_heat[l] = (at.frost + capacity.caught * lying.snow) * heat_of_fusion / step;
        met.water_heat[l] = (at.water + lying.rain) * heat_of_fusion / step;
        const double white = aged_albedo({}, batch.snow_albedo[l], covered.rates[l].melting > 0.0,
                                         0.5 * lying.snow, 0.5 * step);
        met.albedo[l] = albedo_of(batch, l, wet, snow.share, white);
    }
}

bool settle_rates(const EnthalpyForcing& f, const EnthalpyBatch& batch,
                  const std::array<StoreFlows, lying_width>& flows, const LaneMask& solved,
                  int attempt, Covered& covered) {
    bool settled = true;
    for (std::size_t l = 0; l < lying_width; ++l) {
        if (covered.bare[l] || !solved[l]) continue;
        const StoreRates found = flows[l].rates(f.duration[l]);
        const Lying& lying = covered.lying[l];
        settled = settled && alike(lying_over(batch.standing[l], batch.capacity[l], found,
                                              lying.rain, lying.snow, f.duration[l]),
                                   lying, batch.capacity[l]);
        covered.rates[l] = attempt < 3 ? found : middle_of(covered.rates[l], found);
    }
    return settled;
}

void age_snow(double step, double skin, const StoreFlows& flows, std::size_t l,
              EnthalpyBatch& batch) {
    const ThermalSurface& surface = *batch.surface;
    const bool own = surface.snow_albedo.has_value();
    if (!own && !batch.stores()) return;
    const AgeingAlbedo law = surface.snow_albedo.value_or(AgeingAlbedo{});
    double& albedo = batch.snow_albedo[l];
    if (!own && batch.standing[l].frost <= 0.0) {
        albedo = law.fresh;
        return;
    }
    const bool melting = own ? skin >= zero_celsius : flows.melt > 0.0;
    albedo = aged_albedo(law, albedo, melting, flows.snow, step);
}

}  // namespace diurna
