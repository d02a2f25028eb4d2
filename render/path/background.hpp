#pragma once

#include <span>
#include <vector>

#include "materials/atmosphere/onward_light.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

// The background beyond the scene: sky, or below the horizon the air in front of a far plain. That
// is RadianceInput::beyond, level ground with its own material and temperature; without it, a black
// plain at the height of the scene's origin, at the temperature of the air there.

/// Zenith angle [deg] below which a ray from `height_km` ends on the far plain.
double horizon_zenith_deg(const RadianceInput& input, double height_km);

/// Thermal radiance of the background in a direction, per node [W m⁻² sr⁻¹ µm⁻¹], with the
/// sunlight that the far plain reflects.
///
/// - onward: leads from an eye to that height, where a mirror is: what of it arrives at the eye
/// - far: far_ground_light() of these nodes; empty: the plain is black and as warm as the air on it
/// - from_plain: onward_from_plain() of these nodes, for whoever asks for many directions; null: it
///   is found for this one
///
/// Sky light reflected by the plain is attenuated like its emission; for sunlight the path down to
/// the plain is included.
std::vector<double> background_at(const RadianceInput& input, double height_km, double zenith_deg,
                                  std::span<const double> node_um, const SightLine& onward = {},
                                  const LightByOrigin& far = {},
                                  const OnwardLight* from_plain = nullptr);
/// Sunlight that comes from there, under several azimuths, (azimuth)(node): of the sky, or of the
/// air before the plain. Several cost little more than one.
std::vector<std::vector<double>> scattered_backgrounds_at(
    const RadianceInput& input, const SunField& scattered, double height_km, double zenith_deg,
    std::span<const double> azimuth_from_sun_deg, const SightLine& onward = {});

}  // namespace diurna
