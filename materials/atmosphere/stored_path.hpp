#pragma once

#include <span>
#include <vector>

#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/path_spectrum.hpp"

namespace diurna {

/// How a table stores a path: optical depth, and the temperature [K] of the black body whose
/// radiance times 1 − τ is the path's. Both are smooth along the table's axes.
struct StoredPath {
    std::vector<double> depth, temperature;  // (bin)
};

/// From the path's spectrum at the middles of bins; `fallback` is the temperature used for a path
/// with almost no depth.
StoredPath stored(const PathSpectrum& path, BinRange bins, double fallback);

/// The path's spectrum at nodes. Throws InputError for nodes outside the bins.
PathSpectrum restored(const StoredPath& path, BinRange bins, std::span<const double> node_um);

}  // namespace diurna
