#pragma once

#include <span>
#include <vector>

#include "materials/atmosphere/onward_light.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

// What is seen where the scene ends: sky, or below the horizon the air down to a far plain. That is
// RadianceInput::beyond, level ground of a material and temperature of its own; where there is none
// it lies at the height of the scene's origin, black and as warm as the air on it.

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
/// The air takes of what the plain reflects of the sky as much as of what it emits; of sunlight
/// what its way down has left to take.
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
