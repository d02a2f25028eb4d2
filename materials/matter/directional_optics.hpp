#pragma once

#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "materials/matter/microfacet.hpp"

namespace diurna {

/// Shares of the light that meets a surface at an angle or, by Kirchhoff's law, leaves it at that
/// angle: emissivity + mirrored + diffuse + transmittance = 1.
struct DirectionalOptics {
    double emissivity, mirrored, diffuse, transmittance;
};

/// Angle of laboratory measurements and of a material's spectra: 10° from the normal.
inline constexpr double laboratory_cosine = 0.98480775301220806;

/// Reflectance of a glossy interface at a cosine, before it is scaled to the material's spectrum:
/// by its index, or for a metal without one the share s of Schlick's law, R = ρ + (1 − ρ) s. A
/// rough interface takes a thousand evaluations. Zero for other finishes.
double interface_reflectance(const Finish& finish, double wavelength_um, double cosine);
/// The reflectance of one of its microfacets.
double smooth_reflectance(const Glossy& finish, double wavelength_um, double cosine);
/// The microfacets of a finish.
inline Microfacets microfacets_of(const Glossy& finish) {
    return {.roughness = finish.roughness, .gaussian = finish.waves};
}

/// The optics at a wavelength from the interface's values at the angle and at the laboratory's.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine,
                                     double interface_here, double interface_normal);

/// At a wavelength and the cosine of the angle to the normal, 0 to 1. A rough surface takes some
/// thousand evaluations, so use it to fill tables.
DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine);

/// The same averaged over the hemisphere, ∫ f 2 cosθ d cosθ: used in exchange and balance.
DirectionalOptics hemispherical_optics(const Material& material, double wavelength_um);
/// At many wavelengths, in little more time.
std::vector<DirectionalOptics> hemispherical_optics_at(const Material& material,
                                                       std::span<const double> wavelengths_um);

}  // namespace diurna
