#pragma once

#include <optional>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/base/key.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// A path through the air as `diurna path` and Python's diurna.path() define it: its start, its
/// angle there, and one of four ends.
struct AirPath {
    /// [km] allowed heights and ranges
    static constexpr Range heights_km{-0.5, 1e6}, ranges_km{0.0, 1e7};

    double height_km = 0.0;   // start of the path, above the sea
    double zenith_deg = 0.0;  // there
    std::optional<double> range_km, to_height_km;
    bool to_ground = false, to_space = false;
    std::optional<double> sun_zenith_deg;  // if given: scattered sunlight too
    double azimuth_from_sun_deg = 0.0;     // of the path
    double ground_albedo = 0.2;
};

/// The sight line of a path. Throws InputError for a number that is not finite or outside its
/// range, and unless the path has exactly one end and reaches it.
SightLine line_of(const AirPath& path, const BandModel& model);

inline constexpr double contrast_body = 300.0;  // [K]

/// Values of a path in a band.
struct PathInBand {
    double transmittance;       // mean over wavelength
    double thermal, scattered;  // [W m⁻² sr⁻¹]; scattered sunlight is 0 without a sun
    /// Transmittance weighted by Planck's slope at 300 K: the share of the radiance of a small
    /// temperature difference that arrives.
    double contrast = 0.0;
};

/// (band); the bands' breakpoints are bin_edges_um()
std::vector<PathInBand> paths_in_bands(const AirPath& path, const BandModel& model,
                                       const SightLine& line, std::span<const Band> bands);

}  // namespace diurna
