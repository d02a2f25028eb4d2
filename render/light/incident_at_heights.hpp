#pragma once

#include <array>
#include <span>

#include "render/light/far_ground.hpp"
#include "render/light/incident_light.hpp"

namespace diurna {

/// Least, middle and greatest height of what is lit [km above the sea].
using HeightsLit = std::array<double, 3>;

/// The light that falls on surfaces at three heights. Over less than 30 m the middle is the mean of
/// the ends, and one height is computed once: the light of the sky bends over a span Δh by about
/// (Δh / 2 km)² / 8 of itself, less than 1e-4 of what a surface reflects of it
/// (tests/render/radiance_test.cpp), 0.1 mK.
///
/// - scattered: scattered_sun() of these nodes, or null
std::array<IncidentLight, 3> incident_at_heights(const RadianceInput& input,
                                                 const HeightsLit& height_km,
                                                 std::span<const double> node_um,
                                                 const ScatteredSun* scattered);

/// far_ground_light(), with the light found above where that ground lies among those heights and
/// they are close.
///
/// - incident: at the three heights
LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const HeightsLit& height_km,
                               const std::array<IncidentLight, 3>& incident,
                               const ScatteredSun* scattered);

}  // namespace diurna
