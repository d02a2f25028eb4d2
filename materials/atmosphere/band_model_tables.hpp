#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "materials/air/profile.hpp"

namespace diurna {

/// The band model's tables as loaded. Bins ascend in wavelength.
struct BandModelTables {
    /// Absorption of one gas with one pair of exponents: one amount W applies to all its bins.
    struct Group {
        Gas gas;
        double n, m;  // exponents of pressure and temperature
    };
    /// Neighbouring bins of a group: depth of bin `first + k` is exp(a[k] (ln C[k] + ln W)).
    /// The last value is followed by `run_padding` values that give zero depth.
    struct Run {
        std::size_t group;
        std::size_t first, bins;
        std::vector<float> ln_c, a;
    };
    static constexpr std::size_t run_padding = 8;
    /// Bin values that are multiplied by an amount: self continuum, its change with temperature,
    /// foreign continuum, nitrogen, Rayleigh, ozone (visible), nitric acid.
    static constexpr std::size_t linear_count = 7, rayleigh = 4;

    static constexpr std::size_t interval_nodes = 6, haze_zones = 3;

    std::vector<double> edge_um;    // (bin + 1)
    std::vector<double> middle_um;  // (bin), of the middle wavenumber
    std::vector<Group> groups;
    std::vector<Run> runs;
    std::array<std::vector<double>, linear_count> linear;  // (term, bin)

    /// An aerosol's extinction relative to 0.55 µm. Logarithms are linear in the logarithm of the
    /// dryness 100 − RH between the humidities of the table.
    struct Aerosol {
        struct Level {
            double ln_dryness;
            std::vector<double> ln_extinction, extinction, absorption;  // (bin)
        };
        std::vector<Level> levels;  // dryness descending
        /// Extinction (bin) at the Chebyshev nodes of each interval between levels, (interval,
        /// node); one entry for an aerosol with one level. The polynomial is within 2e-7.
        std::vector<std::vector<double>> node;
        std::vector<double> asymmetry;       // (bin) mean cosine of scattering
        std::vector<double> ln_phase;        // (phase wavelength, phase angle)
        std::vector<double> ln_phase_slope;  // its slope [1/deg]
    };
    std::map<std::string, Aerosol> aerosols;
    std::vector<double> phase_um, phase_deg;

    /// Extinction at 0.55 µm [km⁻¹] by height: boundary layer, troposphere, above.
    struct Haze {
        double visibility_km;
        std::vector<double> height_km;
        std::array<std::vector<double>, haze_zones> extinction;  // (zone)(height)
    };
    std::array<std::vector<Haze>, 2> haze;  // spring-summer, autumn-winter; visibility ascending

    std::vector<double> solar_edge_um;  // (solar bin + 1)
    std::vector<double> solar_W_m2_um;  // (solar bin), scaled to `solar_constant`

    std::size_t bins() const { return middle_um.size(); }
};

/// Node k of `count` between 0 and 1.
double chebyshev_node(std::size_t k, std::size_t count);

/// Loaded once, at the first call, from data_folder()/atmosphere; throws InputError if a file is
/// missing or damaged.
const BandModelTables& band_model_tables();

}  // namespace diurna
