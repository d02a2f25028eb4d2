#pragma once

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Irradiance of open level ground [W m⁻²]: all the heat balance needs of the air, from the same
/// atmosphere that the camera's lines of sight use.
struct GroundFluxes {
    double sun_direct = 0.0;   // on a plane facing the sun, 0.3 to 5 µm
    double sun_diffuse = 0.0;  // on the horizontal, from the sky
    double thermal = 0.0;      // on the horizontal, from air and clouds, 3.5 to 100 µm
};

/// Beyond 20 µm, where the model has no bins, the air has the transmittance of the last bin (500 to
/// 525 cm⁻¹), and beyond 28 µm it is black; below 0.351 µm it has that of the first. Thermal flux
/// is within 6 % of Dilley and O'Brien's fit for clear skies, subarctic winter (-5.6 %) to tropics
/// (tests/materials/ground_fluxes_test.cpp); two-stream diffuse sunlight within 15 % of the sum of
/// SunField::sky over the hemisphere (sun_field_test.cpp). Vacuum: no diffuse light, thermal flux
/// of space.
GroundFluxes ground_fluxes(const Atmosphere& atmosphere, const SunLight& sun, double height_km);
/// Sunlight only; and longwave only.
GroundFluxes ground_sunlight(const Atmosphere& atmosphere, const SunLight& sun, double height_km);
/// - sunlight: of the nodes of sunlight_band()
GroundFluxes ground_sunlight(const SunField& sunlight, double height_km);
double ground_longwave(const Atmosphere& atmosphere, double height_km);

/// Where these are summed.
const Band& sunlight_band();
const Band& longwave_band();
/// Water's rotation band: beyond, a hundred metres of air are black.
inline constexpr double black_air_um = 28.0;

}  // namespace diurna
