#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "materials/atmosphere/band_model.hpp"
#include "materials/modtran/deck.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

struct PathGrid;
struct FileGrid;

/// An atmosphere known from a table of paths, of MODTRAN or of another model: interpolated in the
/// heights of both ends and in range, the sky in height and zenith angle. Copies share the table.
struct Tabulated {
    std::shared_ptr<const PathGrid> grid = nullptr;    // made by tabulate(), or
    std::shared_ptr<const FileGrid> file = nullptr;    // read by read_path_table()
    std::shared_ptr<const Profile> profile = nullptr;  // of table_air_temperature; a grid has one
};

/// What a scene's lines span. Lines outside are refused; the sky is known to zenith 90° and below
/// that taken as there.
struct TableExtent {
    double least_from_km = 0.0, most_from_km = 0.0;  // observers, and surfaces that see the sky
    double least_to_km = 0.0, most_to_km = 0.0;      // what is seen
    double least_range_km = 0.01, most_range_km = 10.0;
};

/// One path of a table: between two heights over a range, or from a height to space.
struct TablePath {
    double from_km, to_km, range_km;
    double zenith_deg;  // of paths to space
    bool to_space;
};

/// Transmittance and thermal radiance [W m⁻² sr⁻¹ µm⁻¹] at the middle of each bin asked for.
struct BinPath {
    std::vector<double> transmittance, radiance;
};
/// Where a table's paths come from; asked for many at once.
using PathSource =
    std::function<std::vector<BinPath>(std::span<const TablePath> paths, BinRange bins)>;

PathSource path_source(const BandModel& model);
/// Paths from MODTRAN 5: one tape5 for all, run, and its tape7 averaged over bins. `like` gives all
/// but path and spectral range.
PathSource path_source(const ModtranRunner& runner, const ModtranDeck& like);

/// Error of interpolation, measured where cells are widest from their nodes.
struct TableError {
    std::size_t paths = 0;  // computed, those for the measure included
    double relative = 0.0;  // of radiance at the eye, worst band and place
    double kelvin = 0.0;    // the same as apparent temperature
    bool reached = true;    // the tolerance; else the finest table allowed
};

struct TableTolerance {
    double relative = 1e-3;
    double kelvin = 5e-3;
    std::size_t most_paths = 20000;
};

/// Halves the spacing along the axis that errs most until the error at the middles of its cells, of
/// surfaces at `surface_temperature` and 20 K above seen through the path, is below the tolerance
/// in every band. Deterministic.
///
/// profile  air at the ends, for air_temperature_at; space_temperature behind the sky
Tabulated tabulate(const PathSource& source, const Profile& profile, const TableExtent& extent,
                   std::span<const Band> bands, const TableTolerance& tolerance = {},
                   double surface_temperature = 290.0, double space_temperature = 2.725);

const TableError& table_error(const Tabulated& table);

/// A table of the paths of a tape7 of MODTRAN's (IEMSCT 1 or 2, every run one path of the same
/// wavenumbers): from every H1 to every H2 over some ranges of its own (ITYPE 2; ITYPE 1 where the
/// two are the same), and from some H1 to space under zenith angles from 0 to at least 89° (ITYPE
/// 3). Between them as above, cubic in heights, in range^⅓ and in zenith; shorter than the shortest
/// a path is thinner in proportion; longer ones are refused. `profile` is left to be set.
/// Scattered sun is not read: it belongs to one place of the sun. Throws InputError.
Tabulated read_path_table(const std::filesystem::path& file);

/// What such a table holds.
struct TableSpan {
    TableExtent extent;                            // of paths to surfaces
    double least_sky_km = 0.0, most_sky_km = 0.0;  // of paths to space
    double least_um = 0.0, most_um = 0.0;
    std::size_t paths = 0;
};
TableSpan table_span(const Tabulated& table);

/// Lookups; nodes must lie in the bins of the bands the table was made for.
BinPath table_path(const Tabulated& table, double from_km, double to_km, double range_km,
                   std::span<const double> node_um);
BinPath table_sky(const Tabulated& table, double height_km, double zenith_deg,
                  std::span<const double> node_um);
double table_air_temperature(const Tabulated& table, double height_km);
double table_space_temperature(const Tabulated& table);

}  // namespace diurna
