#pragma once

#include <string>
#include <vector>

#include "scenes/job/run/picture_shares.hpp"
#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// Radiant intensity of an object in one direction and band at an instant.
///
/// Radiant intensity I = ∫ L cosθ dA over its visible surface [W/sr]; contrast intensity I minus
/// that of its background through the same pixels, ΔI = ∫ (L − L_background) cosθ dA, L_background
/// the mean around it in the picture (Jacobs, "Thermal Infrared Characterization of Ground Targets
/// and Backgrounds", 2006, 2.3; NATO AC/243 Panel 4's definition). Through the air both are
/// apparent values: I = E R² with the irradiance E at the eye.
struct SignatureRow {
    Instant when;
    std::string band;
    double aspect_deg, elevation_deg;  // 0 in front of it, 90 on its right-hand side; above level
    double area = 0.0;                 // [m²] visible, projected
    double intensity = 0.0;            // [W/sr]
    double contrast = 0.0;             // [W/sr]; NaN without visible background
    double background = 0.0;           // [W m⁻² sr⁻¹]; NaN the same
};

/// Rows of instants, bands and directions, the last varying fastest. Directions below level are
/// skipped (there is the ground). For directions with range 0, rays begin just outside the sphere
/// around the target, so that they include some metres of air.
struct SignatureReport {
    std::vector<SignatureRow> rows;
    std::size_t below = 0;   // directions skipped
    std::size_t hidden = 0;  // rows in which it is not visible
    std::size_t alone = 0;   // rows in which only it is visible
};

/// Some of the pictures that it makes, to find what they show: 24 directions of each instant,
/// evenly, with one ray a pixel.
std::vector<SeenView> signature_views(const Stages& stages,
                                      const std::vector<SignatureInput>& inputs);

SignatureReport signature_of(const Stages& stages, const SignatureInput& input,
                             const TemperatureField& field, Progress& progress);

}  // namespace diurna
