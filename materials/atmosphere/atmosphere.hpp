#pragma once

#include <span>
#include <variant>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/path_spectrum.hpp"
#include "materials/atmosphere/tabulated.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Nothing between surface and eye; the background has `space_temperature`.
struct Vacuum {
    double space_temperature = 2.725;  // [K]
};

using Atmosphere = std::variant<Vacuum, BandModel, Tabulated>;

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
PathSpectrum path_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                           std::span<const double> node_um);

/// Radiance of the sky at each node [W m⁻² sr⁻¹ µm⁻¹], seen from `height_km` under `zenith_deg`:
/// thermal emission of the air along the path, of the cloud layer over its part of the sky, and of
/// the background behind. Below the horizon the background is a black ground at the temperature of
/// the profile's lowest level. No scattered sunlight. In a vacuum: Planck's law at
/// `space_temperature` in every direction.
///
/// onward  leads from an eye to that height: what of the sky arrives at the eye then, the light of
///         the way itself skipped. The band model takes both for one path, a table multiplies.
std::vector<double> sky_at_nodes(const Atmosphere& atmosphere, double height_km, double zenith_deg,
                                 std::span<const double> node_um, const SightLine& onward = {});

/// The same averaged over the hemisphere above by the cosine of the zenith angle: what a level
/// surface receives, over π. ∫ L cosθ dΩ / π = ∫₀¹ L d(cos²θ), by Gauss and Legendre's rule with so
/// many zenith angles.
std::vector<double> mean_sky_at_nodes(const Atmosphere& atmosphere, double height_km,
                                      std::span<const double> node_um, int zenith_angles,
                                      const SightLine& onward = {});

/// Direct solar irradiance on a plane facing the sun at `height_km`, (node) [W m⁻² µm⁻¹], for the
/// sun at `zenith_deg` (zero where the earth is in between) and `distance_au`. Constant per bin.
/// Direct beam only: what the air scatters out of it is lost. Clouds take their share of it.
/// With `onward`, as for the sky, that share of it which would arrive at the eye.
std::vector<double> solar_at_nodes(const Atmosphere& atmosphere, double height_km,
                                   double zenith_deg, double distance_au,
                                   std::span<const double> node_um, const SightLine& onward = {});

}  // namespace diurna
