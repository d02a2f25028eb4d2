#include "materials/atmosphere/bins.hpp"

#include <algorithm>

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/base/interval.hpp"

namespace diurna {

std::span<const double> bin_edges_um() { return band_model_tables().edge_um; }

std::span<const double> bin_middles_um() { return band_model_tables().middle_um; }

std::size_t bin_of(double wavelength_um) { return interval_of(bin_edges_um(), wavelength_um); }

BinRange bins_of(std::span<const double> wavelengths_um) {
    if (wavelengths_um.empty()) return {};
    const auto [least, most] = std::minmax_element(wavelengths_um.begin(), wavelengths_um.end());
    return {bin_of(*least), bin_of(*most) + 1};
}

}  // namespace diurna
