#pragma once

#include <string>
#include <vector>

#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// How strongly an object shines one way in one band at an instant.
///
/// Radiant intensity I = ∫ L cosθ dA over what is seen of it [W/sr]; contrast intensity that less
/// what its background would send through the same pixels, ΔI = ∫ (L − L_background) cosθ dA,
/// L_background the mean around it in the picture (Jacobs, "Thermal Infrared Characterization of
/// Ground Targets and Backgrounds", 2006, 2.3; NATO AC/243 Panel 4's definition). Through the air
/// both are apparent: I = E R² of the irradiance at the eye.
struct SignatureRow {
    Instant when;
    std::string band;
    double aspect_deg, elevation_deg;  // 0 before its front, 90 on its right-hand side; above level
    double area = 0.0;                 // [m²] seen of it, projected
    double intensity = 0.0;            // [W/sr]
    double contrast = 0.0;             // [W/sr]; NaN where no background is seen
    double background = 0.0;           // [W m⁻² sr⁻¹]; NaN likewise
};

/// Rows of instants, bands and directions, the last the fastest. Directions below the level are
/// skipped (the ground is there); of those seen at the target rays begin just beyond the sphere
/// around it, so that some metres of air are before it.
struct SignatureReport {
    std::vector<SignatureRow> rows;
    std::size_t below = 0;   // directions skipped
    std::size_t hidden = 0;  // rows in which nothing of it is seen
    std::size_t alone = 0;   // rows in which nothing but it is seen
};

SignatureReport signature_of(const Stages& stages, const SignatureInput& input,
                             const TemperatureField& field, Progress& progress);

}  // namespace diurna
