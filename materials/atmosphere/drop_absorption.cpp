#include "materials/atmosphere/drop_absorption.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/csv.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/radiation/spectrum.hpp"

namespace diurna {

namespace {

constexpr double drop_radius_um = 10.0;

const Spectrum& water_extinction() {
    static const Spectrum read = [] {
        Spectrum k;
        const CsvTable table = read_csv(data_folder() / "spectra" / "water_refraction.csv");
        const std::size_t at_um = table.column("wavelength_um"), at_k = table.column("k");
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            k.wavelength_um.push_back(table.number(row, at_um));
            k.value.push_back(table.number(row, at_k));
        }
        return k;
    }();
    return read;
}

}  // namespace

double drop_single_albedo(double wavelength_um) {
    const Spectrum& k = water_extinction();
    const double um = std::clamp(wavelength_um, k.wavelength_um.front(), k.wavelength_um.back());
    const double per_um = 4.0 * std::numbers::pi * k.at(um) / um;
    return 1.0 - 0.5 * -std::expm1(-1.7 * per_um * drop_radius_um);
}

}  // namespace diurna
