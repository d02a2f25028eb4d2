#pragma once

#include <string>

#include "materials/radiation/band.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// Response of an instrument's detector to a band's radiance.
///
/// The flux of a pixel on the axis is per_radiance · ∫ weight(λ) L(λ) dλ, L at the aperture: for a
/// photon detector A fill Ω λ_top/(h c) in electrons/s with weight = response · transmission ·
/// efficiency · λ/λ_top (photons per joule are proportional to wavelength), for a bolometer A fill
/// Ω in pW without λ/λ_top. Ω = π/(4F² + 1), the projected solid angle of the lens for a distant
/// scene (EMVA 1288, 6.1).
struct Response {
    Band scene;                 // with this weight; the band to be rendered
    double per_radiance = 0.0;  // [flux per weighted W m⁻² sr⁻¹]
    double lens = 0.0;          // flux of the lens' own emission, on the axis
    double walls = 0.0;         // flux of walls in place of the lens
    double beside = 0.0;        // of the walls beside the lens, without a cold stop
    double cold = 0.0;          // as `walls`, at the detector's temperature
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
