#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "materials/band.hpp"
#include "materials/profile.hpp"

namespace diurna {

/// A straight sight line, sampled outward from the observer: height and length of each segment.
struct SightLine {
    std::vector<double> height_km;  // of the middle of each segment, above the sea
    std::vector<double> length_km;
};

/// Segments of a line that starts at `height_km` under `zenith_deg` and runs `range_km` over a
/// spherical earth (radius 6371.23 km), fine enough for path radiance to 0.2 %. Infinite range: to
/// the top of the atmosphere (100 km), or to the ground if it points down.
SightLine sight_line(double height_km, double zenith_deg, double range_km);

/// Transmittance and emitted radiance of a path, per bin of the atmosphere's spectral grid.
struct PathSpectrum {
    std::vector<double> transmittance;  // (bin)
    std::vector<double> radiance;  // (bin) thermal, [W m⁻² sr⁻¹ µm⁻¹] at the bin's middle
};

/// Nothing between surface and eye; the background has `space_temperature`.
struct Vacuum {
    double space_temperature = 2.725;  // [K]
};

/// The embedded band model: seven gases, continua, Rayleigh and boundary-layer aerosol on 433 bins
/// of 25 to 200 cm⁻¹. Its table and definition: data_folder()/atmosphere; errors: see the README.
struct BandModel {
    Profile profile;
    std::string aerosol = "none";  // or rural, maritime, urban, tropospheric, desert, ...
    double visibility_km = 23.0;
    double co2_ppm = 420.0;
    double space_temperature = 2.725;  // [K] behind the air
};

using Atmosphere = std::variant<Vacuum, BandModel>;

/// Edges of the spectral bins as wavelengths [µm], ascending (bin count + 1).
std::span<const double> bin_edges_um();
/// The bin that holds a wavelength; bins lie outside the grid at its ends.
std::size_t bin_of(double wavelength_um);

PathSpectrum path_spectrum(const Atmosphere& atmosphere, const SightLine& line);

/// Radiance of the sky from `height_km` under `zenith_deg`, (bin) [W m⁻² sr⁻¹ µm⁻¹]: thermal
/// emission of the air along the path and the background behind it. Below the horizon: the path to
/// the ground alone.
std::vector<double> sky_radiance(const Atmosphere& atmosphere, double height_km, double zenith_deg);

/// Direct solar irradiance on a plane facing the sun at `height_km`, (bin) [W m⁻² µm⁻¹], for the
/// sun at `zenith_deg` (zero at and below the horizon) and `distance_au`.
std::vector<double> solar_irradiance(const Atmosphere& atmosphere, double height_km,
                                     double zenith_deg, double distance_au = 1.0);

/// Band values from bin values: Σ weight · value(bin of node).
double band_sum(const Band& band, std::span<const double> per_bin);
/// Mean over the band weighted by its response.
double band_mean(const Band& band, std::span<const double> per_bin);

}  // namespace diurna
