#include "materials/atmosphere/bins.hpp"

#include <algorithm>

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/base/interval.hpp"

namespace diurna {

std::span<const double> bin_edges_um() { return band_model_tables().edge_um; }

std::span<const double> bin_middles_um() { return band_model_tables().middle_um; }

std::size_t bin_of(double wavelength_um) { return interval_of(bin_edges_um(), wavelength_um); }

std::vector<std::size_t> bin_of_each(std::span<const double> wavelengths_um) {
    const std::span<const double> edge = bin_edges_um();
    std::vector<std::size_t> bin;
    bin.reserve(wavelengths_um.size());
    for (const double um : wavelengths_um) {
        std::size_t at = bin.empty() ? bin_of(um) : bin.back();
        constexpr std::size_t near = 4;  // bins looked through one by one
        if (um < edge[at] || um >= edge[std::min(at + near, edge.size() - 1)]) at = bin_of(um);
        while (at + 2 < edge.size() && um >= edge[at + 1]) ++at;
        bin.push_back(at);
    }
    return bin;
}

BinRange bins_of(std::span<const double> wavelengths_um) {
    if (wavelengths_um.empty()) return {};
    const auto [least, most] = std::minmax_element(wavelengths_um.begin(), wavelengths_um.end());
    return {bin_of(*least), bin_of(*most) + 1};
}

}  // namespace diurna
