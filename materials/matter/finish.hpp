#pragma once

#include <array>
#include <variant>
#include <vector>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

struct Material;

/// Light is sent back alike into all directions, whatever the angle.
struct Lambert {};

/// Microfacets (materials/matter/microfacet.hpp) over a body: gloss paint, varnish, glass, water,
/// metal.
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
};

/// The reflectance by angle as a table of factors to the spectrum, alike into all directions:
/// f = ρ g(θ_in) g(θ_out) / π ḡ, with ḡ the hemispherical mean of g.
struct ByAngle {
    std::vector<double> angle_deg;  // ascending, 0 to 90
    std::vector<double> factor;     // linear between
};

using Finish = std::variant<Lambert, Glossy, ByAngle>;

/// Where light goes that meets a surface at an angle, or by Kirchhoff's law comes from that leaves
/// at it: emissivity + mirrored + diffuse + transmittance = 1.
struct DirectionalOptics {
    double emissivity, mirrored, diffuse, transmittance;
};

/// What a glossy interface reflects at a cosine, before it is held to the material's spectrum: of a
/// dielectric R, of a metal the share s of Schlick's law, R = ρ + (1 − ρ) s. A rough one costs a
/// thousand evaluations. Zero for other finishes.
double interface_reflectance(const Finish& finish, double wavelength_um, double cosine);

/// The optics at a wavelength from the interface's values at the angle and at the laboratory's.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine,
                                     double interface_here, double interface_normal);
inline constexpr double laboratory_cosine = 0.98480775301220806;  // 10°

/// At a wavelength and the cosine of the angle to the normal, 0 to 1; `cosine` 0.985 is 10°, where
/// the material's spectra hold. Costs some thousand evaluations for rough surfaces: for tables.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine);

/// The same averaged over the hemisphere, ∫ f 2 cosθ d cosθ: what counts in exchange and balance.
DirectionalOptics hemispherical_optics(const Material& material, double wavelength_um);

/// How much diffuse reflectance changes with the angle of incidence relative to the hemispherical
/// mean: t(θ) / t̄, so that f = diffuse(θ_out) · this / π.
double diffuse_weight(const Material& material, double wavelength_um, double cosine);

}  // namespace diurna
