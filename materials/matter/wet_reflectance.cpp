#include "materials/matter/wet_reflectance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "materials/base/csv.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/matter/microfacet.hpp"

namespace diurna {

namespace {

constexpr double diffuse_reflectance = 0.066;  // of water's face, any angle as often as it is seen
constexpr double film_um = 20.0;

struct Water {
    Spectrum index, extinction;
};

const Water& water_index() {
    static const Water read = [] {
        Water of;
        const CsvTable table = read_csv(data_folder() / "spectra" / "water_refraction.csv");
        const std::size_t um = table.column("wavelength_um"), n = table.column("n"),
                          k = table.column("k");
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            of.index.wavelength_um.push_back(table.number(row, um));
            of.index.value.push_back(table.number(row, n));
            of.extinction.value.push_back(table.number(row, k));
        }
        of.extinction.wavelength_um = of.index.wavelength_um;
        return of;
    }();
    return read;
}

double water_at(const Spectrum& s, double um) {
    return s.at(std::clamp(um, s.wavelength_um.front(), s.wavelength_um.back()));
}

double under_film(double dry, double face, double index) {
    const double kept_in = 1.0 - (1.0 - diffuse_reflectance) / (index * index);
    return 1.0 - (1.0 - face) * (1.0 - dry) / (1.0 - kept_in * dry);
}

}  // namespace

double wet_reflectance(double dry, double index) {
    return under_film(dry, fresnel(1.0, {index, 0.0}), index);
}

Spectrum wet_reflectance(const Spectrum& dry) {
    Spectrum wet{dry.wavelength_um, {}};
    for (const double um : water_index().index.wavelength_um) {
        if (um > dry.wavelength_um.front() && um < dry.wavelength_um.back()) {
            wet.wavelength_um.push_back(um);
        }
    }
    std::sort(wet.wavelength_um.begin(), wet.wavelength_um.end());
    wet.wavelength_um.erase(std::unique(wet.wavelength_um.begin(), wet.wavelength_um.end()),
                            wet.wavelength_um.end());
    for (const double um : wet.wavelength_um) {
        const double n = water_at(water_index().index, um),
                     k = water_at(water_index().extinction, um);
        // Light that meets the film at 45° goes on at this cosine.
        const double slanting = std::sqrt(1.0 - 0.5 / (n * n));
        const double optical_depth = 4.0 * std::numbers::pi * k / um * film_um;
        const double below = dry.at(um) * std::exp(-2.0 * optical_depth / slanting);
        const double face = fresnel(1.0, std::complex<double>(n, k));
        wet.value.push_back(std::clamp(under_film(below, face, n), 0.0, 1.0));
    }
    return wet;
}

}  // namespace diurna
