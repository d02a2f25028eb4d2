#pragma once

#include <span>

#include "materials/atmosphere/onward_light.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

/// Radiance of the ground beyond the scene's edge (RadianceInput::beyond), (origin)(node) [W m⁻²
/// sr⁻¹ µm⁻¹]: level, without relief, Lambertian,
///
///     J = (1 − ρ) B(T) + ρ [cosθ E_sun / π + L_sky]
///
/// with the sky as on open ground at its height. Sunlight is empty without sunlight; all are empty
/// if the scene has no such ground.
///
/// - scattered: scattered_sun() of these nodes, or null
LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const ScatteredSun* scattered);
/// The same where the light that falls on it is known.
LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const IncidentLight& falls);

/// Path of the far plain's sunlight to an eye, at a band's nodes. Refers to the input's air.
OnwardLight onward_from_plain(const RadianceInput& input, std::span<const double> node_um);

}  // namespace diurna
