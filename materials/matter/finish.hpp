#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

struct MeasuredBrdf;

/// Light is sent back alike into all directions, whatever the angle.
struct Lambert {};

/// Microfacets (materials/matter/microfacet.hpp) over a body: gloss paint, varnish, metal; water in
/// the wind; a pane of glass.
///
/// The spectrum `reflectance` holds near the normal, at 10° as laboratories measure. Of it the
/// interface takes what Fresnel's formula says, or all (metal: what is absorbed goes over the angle
/// as Fresnel's of its index, or by Schlick's law without one); the body sends the rest alike into
/// all directions. What enters the body at an angle, and with that its reflectance, transmittance
/// and emissivity, goes as 1 − R(θ).
struct Glossy {
    double roughness = 0.1;  // α, 0 (a mirror) to 1
    bool metal = false;
    Spectrum index;       // n(λ); of a metal empty: none
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
    /// The measured lobe that the factors are the directional-hemispherical means of: what it
    /// sends towards an eye of sunlight (materials/matter/measured_brdf.hpp). Null: none.
    std::shared_ptr<const MeasuredBrdf> measured = nullptr;
};

using Finish = std::variant<Lambert, Glossy, ByAngle>;

}  // namespace diurna
