#include "materials/atmosphere/scatterers.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"
#include "materials/base/monotone_cubic.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

using ScattererTables = BandModelTables;

constexpr double sea_level_pressure_hPa = 1013.25;

std::vector<double>& scattering_of(Scatterers& sum, std::size_t part) {
    if (sum.part[part].empty()) sum.part[part].assign(sum.rayleigh.size(), 0.0);
    return sum.part[part];
}

/// Adds one zone's aerosol at a dryness, `extinction` [km⁻¹] of it at 0.55 µm.
void add_zone(const ScattererTables::Aerosol& aerosol, std::size_t part, double dryness,
              double extinction, BinRange bins, Scatterers& sum) {
    const auto [low, high, t] = place_of(aerosol, dryness);
    const auto &from = aerosol.levels[low], &to = aerosol.levels[high];
    const double *const ln_from = from.ln_extinction.data() + bins.first,
                        *const ln_to = to.ln_extinction.data() + bins.first,
                        *const absorbed_from = from.absorption.data() + bins.first,
                        *const absorbed_to = to.absorption.data() + bins.first,
                        *const mean_cosine = aerosol.asymmetry.data() + bins.first;
    double *const of_part = scattering_of(sum, part).data(),
                  *const all_extinction = sum.aerosol_extinction.data(),
                  *const all_scattering = sum.aerosol_scattering.data(),
                  *const asymmetry = sum.asymmetry.data();
    const std::size_t count = bins.size();
    const double share = t;
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        const double ext = fast_exp(ln_from[i] + share * (ln_to[i] - ln_from[i]));
        const double absorbed = absorbed_from[i] + share * (absorbed_to[i] - absorbed_from[i]);
        const double left = ext - absorbed;
        const double scattering = extinction * (left > 0.0 ? left : 0.0);
        of_part[i] += scattering;
        all_extinction[i] += extinction * ext;
        all_scattering[i] += scattering;
        asymmetry[i] += scattering * mean_cosine[i];
    }
}

/// Drops of a millimetre: half the extinction is diffraction, and beyond 2.5 µm what enters a drop
/// is absorbed.
void add_rain(double extinction, BinRange bins, Scatterers& sum) {
    std::vector<double>& of_part = scattering_of(sum, 2);
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const bool clear = bin_middles_um()[bins.first + i] < 2.5;
        const double scattering = (clear ? 0.999 : 0.53) * extinction;
        of_part[i] += scattering;
        sum.aerosol_extinction[i] += extinction;
        sum.aerosol_scattering[i] += scattering;
        sum.asymmetry[i] += scattering * (clear ? 0.87 : 0.97);
    }
}

}  // namespace

Scatterers scatterers(const Medium& medium, double height_km) {
    const BinRange bins = medium.bins();
    const std::size_t count = bins.size();
    const AirSample air = air_at(medium.model().profile, height_km);
    const double amagat =
        air.pressure_hPa / sea_level_pressure_hPa * zero_celsius / air.temperature;
    const std::vector<double>& rayleigh = band_model_tables().linear[ScattererTables::rayleigh];
    Scatterers s{.rayleigh = std::vector<double>(count),
                 .aerosol_extinction = std::vector<double>(count, 0.0),
                 .aerosol_scattering = std::vector<double>(count, 0.0),
                 .asymmetry = std::vector<double>(count, 0.0),
                 .part = {}};
    for (std::size_t i = 0; i < count; ++i) s.rayleigh[i] = amagat * rayleigh[bins.first + i];
    const Haze& haze = medium.haze();
    const double drops = haze.rain(height_km);
    if (haze.boundary() != nullptr) {
        const auto [boundary, troposphere, above] = haze.extinction(height_km);
        const double dryness = drops > 0.0 ? 0.0 : ln_dryness(air);
        if (boundary > 0.0) add_zone(*haze.boundary(), 0, dryness, boundary, bins, s);
        if (troposphere > 0.0) add_zone(*haze.tropospheric(), 1, dryness, troposphere, bins, s);
        if (above > 0.0) add_zone(*haze.tropospheric(), 1, std::log(100.0), above, bins, s);
    }
    if (drops > 0.0) add_rain(drops, bins, s);
    for (std::size_t i = 0; i < count; ++i) {
        if (s.aerosol_scattering[i] > 0.0) s.asymmetry[i] /= s.aerosol_scattering[i];
    }
    return s;
}

namespace {

/// (bin) Where its middle lies among the wavelengths of the phase functions.
const std::vector<HermiteWeights>& phase_places() {
    static const std::vector<HermiteWeights> places = [] {
        const ScattererTables& tables = band_model_tables();
        std::vector<HermiteWeights> found;
        for (const double um : tables.middle_um) {
            found.push_back(hermite_weights(tables.phase_um, um));
        }
        return found;
    }();
    return places;
}

}  // namespace

std::array<std::vector<double>, 3> phase_functions(const Medium& medium, double cosine) {
    const ScattererTables& tables = band_model_tables();
    const BinRange bins = medium.bins();
    const HermiteWeights angle =
        hermite_weights(tables.phase_deg, degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    std::array<std::vector<double>, 3> phase;
    const std::array<const ScattererTables::Aerosol*, 2> aerosols = {medium.haze().boundary(),
                                                                     medium.haze().tropospheric()};
    const std::size_t angles = tables.phase_deg.size();
    const std::vector<HermiteWeights>& places = phase_places();
    for (std::size_t k = 0; k < aerosols.size(); ++k) {
        if (aerosols[k] == nullptr) continue;
        std::vector<double> ln;  // (phase wavelength) at the angle
        for (std::size_t row = 0; row < tables.phase_um.size(); ++row) {
            const double* const value = &aerosols[k]->ln_phase[row * angles + angle.low];
            const double* const slope = &aerosols[k]->ln_phase_slope[row * angles + angle.low];
            ln.push_back(angle.value_low * value[0] + angle.slope_low * slope[0] +
                         angle.value_high * value[1] + angle.slope_high * slope[1]);
        }
        phase[k].resize(bins.size());
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const HermiteWeights& um = places[bins.first + i];
            phase[k][i] = ln[um.low] + um.t * (ln[um.low + 1] - ln[um.low]);
        }
        for (double& value : phase[k]) value = fast_exp(value);
    }
    phase[2].assign(bins.size(), henyey_greenstein(0.9, cosine));  // drops
    return phase;
}

}  // namespace diurna
