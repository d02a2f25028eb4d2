#pragma once

#include <span>
#include <vector>

#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/path_spectrum.hpp"

namespace diurna {

/// What a table keeps of a path, smooth along the table's axes: optical depth, and the temperature
/// [K] of the black body whose light times 1 − τ is the path's.
struct StoredPath {
    std::vector<double> depth, temperature;  // (bin)
};

/// From the path's spectrum at the middles of bins; `fallback` is the temperature of one as good as
/// empty.
StoredPath stored(const PathSpectrum& path, BinRange bins, double fallback);

/// Its spectrum at nodes. Throws InputError for nodes outside the bins.
PathSpectrum restored(const StoredPath& path, BinRange bins, std::span<const double> node_um);

}  // namespace diurna
