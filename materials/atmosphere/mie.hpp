#pragma once

#include <complex>
#include <span>
#include <vector>

namespace diurna {

/// Efficiencies of a homogeneous sphere: cross sections over its geometric cross section.
struct MieEfficiency {
    double extinction, scattering;
    double asymmetry;  // mean cosine of scattering
};

/// Mie's series for a sphere of index n − ik (k ≥ 0) and size parameter x = 2πr/λ, 1e-3 to 5000.
///
/// Logarithmic derivative by downward recurrence, Wiscombe's number of terms.
/// Source: Bohren and Huffman 1983, chapter 4; checked against their table
/// (tests/materials/mie_test.cpp).
MieEfficiency mie(std::complex<double> index, double size_parameter);

/// A mode of a size distribution, lognormal or modified gamma:
///
///     dN/d ln r = number · exp(−ln²(r/r₀) / 2 s²) / (√2π s),  s = σ ln 10
///
///     dN/d ln r ∝ r^(α+1) exp(−(α/γ) (r/r₀)^γ)
struct SizeMode {
    double number = 1.0;
    double radius_um = 0.1;  // r₀
    double sigma_log10 = 0.35;
    double alpha = 0.0, gamma = 0.0;  // both positive: modified gamma
};

/// Mean over modes, weighted by cross sections: extinction and scattering per particle [µm²].
struct MieMean {
    double extinction = 0.0, scattering = 0.0, asymmetry = 0.0;
};
MieMean mie_mean(std::span<const SizeMode> modes, std::span<const std::complex<double>> index,
                 double wavelength_um);

/// Phase function of unpolarised light at the given cosines of the scattering angle, with mean 1
/// over the sphere, for the same mean over modes.
std::vector<double> mie_phase(std::span<const SizeMode> modes,
                              std::span<const std::complex<double>> index, double wavelength_um,
                              std::span<const double> cosine);

}  // namespace diurna
