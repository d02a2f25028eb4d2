#pragma once

#include <memory>
#include <span>
#include <vector>

#include "materials/air/profile.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/path_spectrum.hpp"
#include "materials/atmosphere/stored_path.hpp"

namespace diurna {

/// The range of a table of paths. Lines outside are refused; the sky is tabulated to zenith 90°,
/// and larger angles take the value at 90°.
struct TableSpan {
    double least_from_km = 0.0, most_from_km = 0.0;  // heights of observers
    double least_to_km = 0.0, most_to_km = 0.0;      // of the points they see
    double most_range_km = 0.0;
    double least_sky_km = 0.0, most_sky_km = 0.0;  // of places that see the sky
    double least_um = 0.0, most_um = 0.0;
    std::size_t paths = 0;
};

/// Paths at nodes of one axis, ascending.
struct PathRow {
    std::vector<double> node;
    std::vector<StoredPath> path;
};

/// Paths from every height of `from` to every one of `to` over one or more ranges, and to space
/// from every one of `sky_from` under several zenith angles. Interpolation is cubic in heights, in
/// range^⅓ and in zenith_variable(); a path shorter than the shortest has a proportional depth.
struct TabulatedPaths {
    BinRange bins;
    std::vector<double> from, to, sky_from;  // [km], ascending
    std::vector<PathRow> path;               // (from, to), over range^⅓ [km^⅓]
    std::vector<PathRow> sky;                // (sky_from), over zenith_variable()
    TableSpan span;
};

/// An atmosphere given only by a table of paths. Copies share the table.
struct Tabulated {
    std::shared_ptr<const TabulatedPaths> paths;
    std::shared_ptr<const Profile> profile;  // air temperature where lines leave the scene
    double space_temperature = 2.725;        // [K] behind the sky
};

/// Spacing of zenith angles, denser towards the horizon: 1 − √(1 − zenith / 90°).
double zenith_variable(double zenith_deg);

/// A path between two heights over a range, and one to space. Throw InputError outside the range of
/// the table.
PathSpectrum table_path(const TabulatedPaths& table, double from_km, double to_km, double range_km,
                        std::span<const double> node_um);
PathSpectrum table_sky(const TabulatedPaths& table, double height_km, double zenith_deg,
                       std::span<const double> node_um);

}  // namespace diurna
