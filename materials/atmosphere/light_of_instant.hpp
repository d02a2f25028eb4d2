#pragma once

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/atmosphere/sunlit_air.hpp"

namespace diurna {

/// The light at an instant: an air whose beam, scattered sunlight and longwave, by wavelength and
/// direction, add up at the ground to the broadband sums in `sums`. The heat balance uses the sums,
/// pictures use the air: so they agree.
struct LightOfInstant {
    Atmosphere air;
    GroundFluxes sums;       // of `air`, under the sun it was computed for
    double cloud_cover = 0;  // 0 to 1, as used for the longwave
};

/// The known sums of an instant [W m⁻²]; NaN: use the model's value.
struct KnownLight {
    double direct_normal, diffuse, longwave_down;
};

/// A model that has the known sums (measured, or computed for the heat balance). The model's cloud
/// fraction is the observed one.
///
///  1. Longwave: the share of black cloud, between the model's clear and overcast sky, that gives
///     the known longwave (by day and by night); with a sun above 5° no more cloud than the known
///     beam allows, 1 − beam over the clear model's. A remaining difference changes the emitting
///     column (LightScale::sky_column: opaque bands keep the air's temperature, windows change),
///     and what no column can give becomes a grey factor.
///  2. Beam and diffuse: the cloud (part of the sky, optical depth) that leaves these shares of the
///     clear model's (cloud_of_effect), unless the sky was observed to be clear. A remaining
///     difference becomes grey factors below the cloud, one for the beam and one for the diffuse.
///
/// Nothing is scaled if the model's value is zero (a sun below the horizon). Sums agree to 1e-3
/// with ground_fluxes() of the result, which are in `sums`
/// (tests/materials/light_of_instant_test.cpp).
LightOfInstant light_of_instant(const BandModel& model, const SunLight& sun, double height_km,
                                const KnownLight& known);

}  // namespace diurna
