#pragma once

#include <string>

#include "materials/radiation/band.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// What a band's radiance is worth to an instrument's detector.
///
/// The flux of a pixel on the axis is per_radiance · ∫ weight(λ) L(λ) dλ, L at the aperture: of a
/// photon detector A fill Ω λ_top/(h c) in electrons/s with weight = response · transmission ·
/// efficiency · λ/λ_top (photons per joule go with wavelength), of a bolometer A fill Ω in pW
/// without λ/λ_top. Ω = π/(4F² + 1), the projected solid angle of the lens far from what it looks
/// at (EMVA 1288, 6.1).
struct Response {
    Band scene;                 // of its weight; what is to be rendered
    double per_radiance = 0.0;  // [flux per W m⁻² sr⁻¹ so weighted]
    double lens = 0.0;          // flux of the lens' own emission, on the axis
    double walls = 0.0;         // of what would be seen in its place if the lens were wall
    double beside = 0.0;        // of the walls beside the lens, without a cold stop
    double cold = 0.0;          // as `walls`, were these as cold as the detector
    std::string unit;           // of the signal: "e-", "pW"

    /// Flux of a black body that fills the field, on the axis.
    double black_body(double temperature) const;
    double black_body_slope(double temperature) const;  // [flux per K]
};

/// - housing_temperature: [K]; the instrument's own if not above zero
Response response_of(const Instrument& instrument, const Band& band,
                     double housing_temperature = 0.0);

/// The weight of Response::scene for a band of that response.
Spectrum scene_weight(const Instrument& instrument, const Spectrum& response);

}  // namespace diurna
