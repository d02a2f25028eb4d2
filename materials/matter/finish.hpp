#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

struct MeasuredBrdf;

/// Reflects light equally into all directions, at any angle of incidence.
struct Lambert {};

/// Microfacets (materials/matter/microfacet.hpp) over a body: gloss paint, varnish, metal; water
/// under wind; a pane of glass.
///
/// The spectrum `reflectance` is that near the normal, at 10° as measured in laboratories. The
/// interface reflects the share by Fresnel's formula, or all (metal: angular dependence by
/// Fresnel with its index, or by Schlick); the body reflects the rest equally into all
/// directions. Light entering the body, and so its reflectance, transmittance and emissivity,
/// goes with 1 − R(θ).
/// and emissivity, is proportional to 1 − R(θ).
/// and emissivity, goes as 1 − R(θ).
struct Glossy {
    double roughness = 0.1;  // α, 0 (a mirror) to 1
    bool metal = false;
    Spectrum index;       // n(λ); empty for a metal without one
    Spectrum extinction;  // k(λ); empty without one
    /// Water: its slopes are Gaussian and depend on the wind (materials/matter/waves.hpp);
    /// `roughness` is that of the wind used for the means.
    bool waves = false;
    /// A sheet with two smooth faces with multiple reflection (materials/matter/pane.hpp).
    bool pane = false;
};

/// Angular factors to the spectrum as a table, the same in all azimuths: f = ρ g(θ_in) g(θ_out) / π
/// ḡ, with ḡ the hemispherical mean of g.
struct ByAngle {
    std::vector<double> angle_deg;  // ascending, 0 to 90
    std::vector<double> factor;     // linear between
    /// The measured lobe, of which the factors are the directional-hemispherical means: gives the
    /// sunlight reflected to an observer (materials/matter/measured_brdf.hpp). Null without one.
    std::shared_ptr<const MeasuredBrdf> measured = nullptr;
};

using Finish = std::variant<Lambert, Glossy, ByAngle>;

}  // namespace diurna
