#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// A function of wavelength: linear between its points, zero outside them.
struct Spectrum {
    std::vector<double> wavelength_um;  // strictly ascending
    std::vector<double> value;          // same length; unit depends on use

    bool empty() const { return value.empty(); }
    double at(double wavelength) const;  // wavelength [µm]
};

/// ∫ s dλ over its whole range, or over [from_um, to_um]; exact for the piecewise-linear function.
double integral(const Spectrum& s);
double integral(const Spectrum& s, double from_um, double to_um);

/// Mean of `s` weighted by `weight` over their common range: ∫ s·w dλ / ∫ w dλ.
/// The product of two linear pieces is integrated exactly (Simpson on the union of the grids).
double weighted_mean(const Spectrum& s, const Spectrum& weight);

/// The constant `value` over [from_um, to_um].
Spectrum flat_spectrum(double value, double from_um = 0.2, double to_um = 100.0);

/// Reads two columns `wavelength_um,<name>`; checks ascending wavelengths and, where
/// given, the range [least, most] of the values. Throws InputError with file:line:column.
Spectrum read_spectrum(const std::filesystem::path& path, double least = -1e300,
                       double most = 1e300);

/// Name of the column of values: "reflectance".
std::string column_of_spectrum(const std::filesystem::path& path);

}  // namespace diurna
