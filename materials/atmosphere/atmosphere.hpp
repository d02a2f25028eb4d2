#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/path_grid.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Nothing between surface and eye; the background has `space_temperature`.
struct Vacuum {
    double space_temperature = 2.725;  // [K]
};

using Atmosphere = std::variant<Vacuum, BandModel, Tabulated>;

/// Throws InputError if the atmosphere cannot be used.
void check(const Atmosphere& atmosphere);

/// Temperature of the air at a height [K]; of space in a vacuum.
double air_temperature_at(const Atmosphere& atmosphere, double height_km);

/// Transmittance and thermal radiance of a path at given wavelengths.
///
/// Transmittance is constant within a bin of the band model; Planck's law is evaluated at the
/// wavelength itself, within a segment linear in optical depth between its ends' temperatures (of
/// its middle's, for a line that does not know its ends). So a Band whose breakpoints include
/// bin_edges_um() integrates both to its quadrature's accuracy, and air at one temperature in front
/// of a black body of that temperature is that black body: radiance + transmittance · B(T) = B(T)
/// at every wavelength.
struct NodeSpectrum {
    std::vector<double> transmittance;  // (node) 0 to 1
    std::vector<double> radiance;       // (node) [W m⁻² sr⁻¹ µm⁻¹]
};
NodeSpectrum path_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                           std::span<const double> node_um);

/// The same to the far end of every segment of the line: (segment) entries for little more than
/// the cost of the last, which is `path_at_nodes`. For tables over range.
std::vector<NodeSpectrum> paths_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                                         std::span<const double> node_um);

/// Lines from a height as the model's air bends them, or straight if it has no refraction.
SightLine line_of(const BandModel& model, double height_km, double zenith_deg,
                  double range_km = std::numeric_limits<double>::infinity(),
                  const Segmentation& segmentation = {});
bool ends_on_ground(const BandModel& model, double height_km, double zenith_deg);

/// Radiance of the sky at each node [W m⁻² sr⁻¹ µm⁻¹], seen from `height_km` under `zenith_deg`:
/// thermal emission of the air along the path, of the cloud layer over its part of the sky, and of
/// the background behind. Below the horizon the background is a black ground at the temperature of
/// the profile's lowest level. No scattered sunlight. In a vacuum: Planck's law at
/// `space_temperature` in every direction.
std::vector<double> sky_at_nodes(const Atmosphere& atmosphere, double height_km, double zenith_deg,
                                 std::span<const double> node_um);

/// The same averaged over the hemisphere above by the cosine of the zenith angle: what a level
/// surface receives, over π. ∫ L cosθ dΩ / π = ∫₀¹ L d(cos²θ), by Gauss and Legendre's rule with so
/// many zenith angles.
std::vector<double> mean_sky_at_nodes(const Atmosphere& atmosphere, double height_km,
                                      std::span<const double> node_um, int zenith_angles);

/// Direct solar irradiance on a plane facing the sun at `height_km`, (node) [W m⁻² µm⁻¹], for the
/// sun at `zenith_deg` (zero where the earth is in between) and `distance_au`. Constant per bin.
/// Direct beam only: what the air scatters out of it is lost. Clouds take their share of it.
std::vector<double> solar_at_nodes(const Atmosphere& atmosphere, double height_km,
                                   double zenith_deg, double distance_au,
                                   std::span<const double> node_um);

/// Transmittance and thermal radiance of a path per bin; the radiance at the bin's middle
/// wavenumber [W m⁻² sr⁻¹ µm⁻¹]. For printing spectra; integrals go through the nodes of a Band.
struct PathSpectrum {
    std::vector<double> transmittance;  // (bin)
    std::vector<double> radiance;       // (bin)
};
PathSpectrum path_spectrum(const Atmosphere& atmosphere, const SightLine& line);

/// Middle of each bin [µm]: the wavelength of its middle wavenumber.
std::span<const double> bin_middles_um();

/// sky_at_nodes and solar_at_nodes at bin_middles_um(), (bin).
std::vector<double> sky_radiance(const Atmosphere& atmosphere, double height_km, double zenith_deg);
std::vector<double> solar_irradiance(const Atmosphere& atmosphere, double height_km,
                                     double zenith_deg, double distance_au = 1.0);

/// Σ weight · value over a band's nodes, of values per node or per bin (value of the node's bin).
double band_sum_nodes(const Band& band, std::span<const double> per_node);
double band_sum(const Band& band, std::span<const double> per_bin);
/// Mean over the band weighted by its response.
double band_mean_nodes(const Band& band, std::span<const double> per_node);
double band_mean(const Band& band, std::span<const double> per_bin);

}  // namespace diurna
