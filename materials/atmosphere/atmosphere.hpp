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

/// No air between surface and observer; the background has `space_temperature`.
struct Vacuum {
    double space_temperature = 2.725;  // [K]
};

using Atmosphere = std::variant<Vacuum, BandModel, Tabulated>;

/// Temperature of the air at a height [K]; of space in a vacuum.
double air_temperature_at(const Atmosphere& atmosphere, double height_km);

/// Transmittance and thermal radiance of a path at given wavelengths.
///
/// Transmittance is constant within a bin of the band model; Planck's law is evaluated at the
/// wavelength itself. Within a segment it is linear in optical depth between the temperatures of
/// the ends (of the middles, for a line without known ends). So a Band whose breakpoints include
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
/// onward  path from an observer to that height: returns what of the sky's light arrives there,
///         without that path's light. The band model treats both as one path, a table multiplies.
std::vector<double> sky_at_nodes(const Atmosphere& atmosphere, double height_km, double zenith_deg,
                                 std::span<const double> node_um, const SightLine& onward = {});

/// The same averaged over the upper hemisphere, weighted by the cosine of the zenith angle: the
/// irradiance of a level surface divided by π. ∫ L cosθ dΩ / π = ∫₀¹ L d(cos²θ), by Gauss-Legendre
/// quadrature with the given number of zenith angles.
std::vector<double> mean_sky_at_nodes(const Atmosphere& atmosphere, double height_km,
                                      std::span<const double> node_um, int zenith_angles,
                                      const SightLine& onward = {});

/// Direct solar irradiance on a plane facing the sun at `height_km`, (node) [W m⁻² µm⁻¹], for the
/// sun at `zenith_deg` (zero where the earth is in between) and `distance_au`. Constant per bin.
/// Direct beam only: light scattered out of it is lost. Clouds reduce it. With `onward`: the part
/// of it that would arrive at the observer, as for the sky.
std::vector<double> solar_at_nodes(const Atmosphere& atmosphere, double height_km,
                                   double zenith_deg, double distance_au,
                                   std::span<const double> node_um, const SightLine& onward = {});

}  // namespace diurna
