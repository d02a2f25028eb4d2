#include <algorithm>
#include <cmath>

#include "materials/atmosphere/medium.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/monotone_cubic.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

using Tables = BandModelTables;

constexpr double standard_pressure_hPa = 1013.25;
constexpr double standard_temperature = 273.15;
constexpr std::size_t rayleigh_term = 4;

}  // namespace

Scatterers Medium::scatterers(double height_km) const {
    const AirSample air = air_at(model_.profile, height_km);
    const std::size_t count = bins_.size();
    const double amagat =
        air.pressure_hPa / standard_pressure_hPa * standard_temperature / air.temperature;
    Scatterers s{.rayleigh = std::vector<double>(count),
                 .aerosol_extinction = std::vector<double>(count, 0.0),
                 .aerosol_scattering = std::vector<double>(count, 0.0),
                 .asymmetry = std::vector<double>(count, 0.0),
                 .part = {}};
    for (std::size_t i = 0; i < count; ++i) {
        s.rayleigh[i] = amagat * tables_.linear[rayleigh_term][bins_.first + i];
    }
    const auto mix = [&](std::size_t part, std::size_t i, double extinction, double scattering,
                         double asymmetry) {
        if (s.part[part].empty()) s.part[part].assign(count, 0.0);
        s.part[part][i] += scattering;
        s.aerosol_extinction[i] += extinction;
        s.aerosol_scattering[i] += scattering;
        s.asymmetry[i] += scattering * asymmetry;
    };
    const double drops = rain(height_km);
    if (boundary_ != nullptr) {
        const auto extinction = haze(height_km);
        for (std::size_t zone = 0; zone < zones; ++zone) {
            if (extinction[zone] <= 0.0) continue;
            const Tables::Aerosol& aerosol = zone == 0 ? *boundary_ : *tropospheric_;
            const double dryness =
                zone == 2 ? std::log(100.0) : (drops > 0.0 ? 0.0 : ln_dryness(air));
            const auto [low, high, t] = place_of(aerosol, dryness);
            const auto &from = aerosol.levels[low], &to = aerosol.levels[high];
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t bin = bins_.first + i;
                const double ext = fast_exp(from.ln_extinction[bin] +
                                            t * (to.ln_extinction[bin] - from.ln_extinction[bin]));
                const double absorbed =
                    from.absorption[bin] + t * (to.absorption[bin] - from.absorption[bin]);
                mix(zone == 0 ? 0 : 1, i, extinction[zone] * ext,
                    extinction[zone] * std::max(0.0, ext - absorbed), aerosol.asymmetry[bin]);
            }
        }
    }
    if (drops > 0.0) {
        // Drops of a millimetre: half the extinction is diffraction, and beyond 2.5 um what enters
        // a drop is absorbed.
        for (std::size_t i = 0; i < count; ++i) {
            const bool clear = tables_.middle_um[bins_.first + i] < 2.5;
            mix(2, i, drops, (clear ? 0.999 : 0.53) * drops, clear ? 0.87 : 0.97);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (s.aerosol_scattering[i] > 0.0) s.asymmetry[i] /= s.aerosol_scattering[i];
    }
    return s;
}

std::array<std::vector<double>, 3> Medium::phase(double cosine) const {
    const HermiteWeights angle =
        hermite_weights(tables_.phase_deg, degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    std::array<std::vector<double>, 3> phase;
    const std::array<const Tables::Aerosol*, 2> aerosols = {boundary_, tropospheric_};
    const std::size_t angles = tables_.phase_deg.size();
    for (std::size_t k = 0; k < aerosols.size(); ++k) {
        if (aerosols[k] == nullptr) continue;
        std::vector<double> ln;  // (phase wavelength) at the angle
        for (std::size_t row = 0; row < tables_.phase_um.size(); ++row) {
            const double* const value = &aerosols[k]->ln_phase[row * angles + angle.low];
            const double* const slope = &aerosols[k]->ln_phase_slope[row * angles + angle.low];
            ln.push_back(angle.value_low * value[0] + angle.slope_low * slope[0] +
                         angle.value_high * value[1] + angle.slope_high * slope[1]);
        }
        for (std::size_t bin = bins_.first; bin < bins_.last; ++bin) {
            const HermiteWeights um = hermite_weights(tables_.phase_um, tables_.middle_um[bin]);
            phase[k].push_back(fast_exp(ln[um.low] + um.t * (ln[um.low + 1] - ln[um.low])));
        }
    }
    constexpr double g = 0.9;  // of drops: Henyey and Greenstein's form
    const double d = 1.0 + g * g - 2.0 * g * cosine;
    phase[2].assign(bins_.size(), (1.0 - g * g) / (d * std::sqrt(d)));
    return phase;
}

}  // namespace diurna
