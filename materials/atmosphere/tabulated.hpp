#pragma once

#include <memory>
#include <span>
#include <vector>

#include "materials/air/profile.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/path_spectrum.hpp"
#include "materials/atmosphere/stored_path.hpp"

namespace diurna {

/// What a table of paths spans. Lines outside are refused; the sky is known to zenith 90° and below
/// that taken as there.
struct TableSpan {
    double least_from_km = 0.0, most_from_km = 0.0;  // heights of observers
    double least_to_km = 0.0, most_to_km = 0.0;      // of what they see
    double most_range_km = 0.0;
    double least_sky_km = 0.0, most_sky_km = 0.0;  // of who sees the sky
    double least_um = 0.0, most_um = 0.0;
    std::size_t paths = 0;
};

/// Paths at nodes of one axis, ascending.
struct PathRow {
    std::vector<double> node;
    std::vector<StoredPath> path;
};

/// Paths from every height of `from` to every one of `to` over some ranges of its own, and to space
/// from every one of `sky_from` under some zenith angles. Between them: cubic in heights, in
/// range^⅓ and in zenith_variable(); a path shorter than the shortest is thinner in proportion.
struct TabulatedPaths {
    BinRange bins;
    std::vector<double> from, to, sky_from;  // [km], ascending
    std::vector<PathRow> path;               // (from, to), over range^⅓ [km^⅓]
    std::vector<PathRow> sky;                // (sky_from), over zenith_variable()
    TableSpan span;
};

/// An atmosphere known from a table of paths alone. Copies share the table.
struct Tabulated {
    std::shared_ptr<const TabulatedPaths> paths;
    std::shared_ptr<const Profile> profile;  // how warm the air is where lines leave the scene
    double space_temperature = 2.725;        // [K] behind the sky
};

/// Zenith angles crowd towards the horizon: 1 − √(1 − zenith / 90°).
double zenith_variable(double zenith_deg);

/// A path between two heights over a range, and one to space. Throw InputError for what the table
/// does not span.
PathSpectrum table_path(const TabulatedPaths& table, double from_km, double to_km, double range_km,
                        std::span<const double> node_um);
PathSpectrum table_sky(const TabulatedPaths& table, double height_km, double zenith_deg,
                       std::span<const double> node_um);

}  // namespace diurna
