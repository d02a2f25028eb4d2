#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace diurna {

/// Edges of the atmosphere's spectral bins as wavelengths [µm], ascending (bin count + 1): 0.351 to
/// 20, 25 to 200 cm⁻¹ wide. Transmittance is constant within a bin, so a Band whose breakpoints
/// include them is integrated to its quadrature's accuracy.
std::span<const double> bin_edges_um();
/// Middle of each bin [µm]: the wavelength of its middle wavenumber.
std::span<const double> bin_middles_um();
inline std::size_t bin_count() { return bin_middles_um().size(); }
/// The bin that holds a wavelength; outside the grid the first or the last bin.
std::size_t bin_of(double wavelength_um);
/// The bins of wavelengths, which is fast where they ascend.
std::vector<std::size_t> bin_of_each(std::span<const double> wavelengths_um);

/// Bins [first, last): computing time is proportional to their number.
struct BinRange {
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t size() const { return last - first; }
};
/// The bins that hold the given wavelengths, from the shortest to the longest.
BinRange bins_of(std::span<const double> wavelengths_um);

}  // namespace diurna
