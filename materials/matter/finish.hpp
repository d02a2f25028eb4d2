#pragma once

#include <variant>
#include <vector>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Light is sent back alike into all directions, whatever the angle.
struct Lambert {};

/// Microfacets (materials/matter/microfacet.hpp) over a body: gloss paint, varnish, metal; water in
/// the wind; a pane of glass.
///
/// The spectrum `reflectance` holds near the normal, at 10° as laboratories measure. Of it the
/// interface takes what Fresnel's formula says, or all (metal, Schlick's law of angle); the body
/// sends the rest alike into all directions. What enters the body at an angle, and with that its
/// reflectance, transmittance and emissivity, goes as 1 − R(θ).
struct Glossy {
    double roughness = 0.1;  // α, 0 (a mirror) to 1
    bool metal = false;
    Spectrum index;       // n(λ); of a dielectric
    Spectrum extinction;  // k(λ); empty: none
    /// Water: its slopes are Gaussian and the wind's (materials/matter/waves.hpp); `roughness` is
    /// that of the wind that means are taken at.
    bool waves = false;
    /// A sheet with two smooth faces that reflect to and fro (materials/matter/pane.hpp).
    bool pane = false;
};

/// The reflectance by angle as a table of factors to the spectrum, alike into all directions:
/// f = ρ g(θ_in) g(θ_out) / π ḡ, with ḡ the hemispherical mean of g.
struct ByAngle {
    std::vector<double> angle_deg;  // ascending, 0 to 90
    std::vector<double> factor;     // linear between
};

using Finish = std::variant<Lambert, Glossy, ByAngle>;

}  // namespace diurna
