#pragma once

#include <span>
#include <vector>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/path_grid.hpp"
#include "materials/modtran/modtran.hpp"

namespace diurna {

/// What is stored of a path, smooth along the axes: optical depth, and the temperature of the black
/// body whose light times 1 − τ is the path's.
struct Stored {
    std::vector<double> depth, temperature;  // (bin)
};
Stored stored(const BinPath& path, BinRange bins, double fallback);
BinPath restored(std::span<const double> depth, std::span<const double> temperature,
                 std::span<const double> node_um, BinRange bins);

/// Zenith angles crowd towards the horizon: v = 1 − √(1 − zenith / 90°).
double variable_of(double zenith_deg);

/// Means of a run over bins' wavenumbers. Throws std::runtime_error for a bin without a row.
BinPath binned(const Tape7Run& run, BinRange bins);

/// Lookups in the paths of a file.
struct FileGrid;
BinPath file_path(const FileGrid& grid, double from_km, double to_km, double range_km,
                  std::span<const double> node_um);
BinPath file_sky(const FileGrid& grid, double height_km, double zenith_deg,
                 std::span<const double> node_um);

}  // namespace diurna
