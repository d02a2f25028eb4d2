#pragma once

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/atmosphere/sunlit_air.hpp"

namespace diurna {

/// The light of an instant: an air whose beam, scattered sunlight and longwave, by wavelength and
/// direction, add up at the ground to the broadband sums beside it. The heat balance takes the
/// sums, pictures the air: they cannot disagree.
struct LightOfInstant {
    Atmosphere air;
    GroundFluxes sums;       // of `air` under the sun it was made for
    double cloud_cover = 0;  // 0 to 1, as the longwave and whoever looked up have it
};

/// What is known of an instant's sums [W m⁻²]; NaN: take the model's own.
struct KnownLight {
    double direct_normal, diffuse, longwave_down;
};

/// A model made to have the sums that are known (measured, or found by whoever computes the heat
/// balance). The model's cloud fraction is what was observed of it.
///
///  1. Longwave: the share of black cloud, between the model's clear and overcast sky, that gives
///     it (by day and by night); with a sun above 5° no more cloud than the known beam leaves room
///     for, 1 − beam over the clear model's. What is left over goes into the sky's emitting column
///     (LightScale::sky_column: opaque bands keep the air's temperature, windows give way), and
///     what no column can give into a grey factor.
///  2. Beam and diffuse: the cloud (part of the sky, optical depth) that leaves these of the clear
///     model's (cloud_of_effect), unless the sky was observed to be clear. What is left over is
///     grey, beam and diffuse apart, below the cloud.
///
/// Nothing is scaled where there is nothing to scale: a sun below the horizon, light the model has
/// none of. Sums agree to 1e-3 with ground_fluxes() of the result, which are in `sums`
/// (tests/materials/light_of_instant_test.cpp).
LightOfInstant light_of_instant(const BandModel& model, const SunLight& sun, double height_km,
                                const KnownLight& known);

}  // namespace diurna
