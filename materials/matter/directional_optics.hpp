#pragma once

#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "materials/matter/microfacet.hpp"

namespace diurna {

/// Where light goes that meets a surface at an angle, or by Kirchhoff's law comes from that leaves
/// at it: emissivity + mirrored + diffuse + transmittance = 1.
struct DirectionalOptics {
    double emissivity, mirrored, diffuse, transmittance;
};

/// Where laboratories measure, and a material's spectra hold: 10° from the normal.
inline constexpr double laboratory_cosine = 0.98480775301220806;

/// What a glossy interface reflects at a cosine, before it is held to the material's spectrum: by
/// its index, or of a metal without one the share s of Schlick's law, R = ρ + (1 − ρ) s. A rough
/// one costs a thousand evaluations. Zero for other finishes.
double interface_reflectance(const Finish& finish, double wavelength_um, double cosine);
/// The same of one of its microfacets.
double smooth_reflectance(const Glossy& finish, double wavelength_um, double cosine);
/// The microfacets of a finish.
inline Microfacets microfacets_of(const Glossy& finish) {
    return {.roughness = finish.roughness, .gaussian = finish.waves};
}

/// The optics at a wavelength from the interface's values at the angle and at the laboratory's.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine,
                                     double interface_here, double interface_normal);

/// At a wavelength and the cosine of the angle to the normal, 0 to 1. Costs some thousand
/// evaluations for rough surfaces: for tables.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine);

/// The same averaged over the hemisphere, ∫ f 2 cosθ d cosθ: what counts in exchange and balance.
DirectionalOptics hemispherical_optics(const Material& material, double wavelength_um);
/// At many wavelengths, for little more.
std::vector<DirectionalOptics> hemispherical_optics_at(const Material& material,
                                                       std::span<const double> wavelengths_um);

}  // namespace diurna
