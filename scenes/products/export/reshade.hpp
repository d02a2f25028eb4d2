#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "materials/matter/material.hpp"
#include "render/picture/frame.hpp"

namespace diurna {

/// A change of one object in a picture that lists the surfaces of its pixels (`surfaces = N`,
/// docs/reference/planes.md). Where nothing is set the picture's values remain.
struct SurfaceChange {
    std::optional<double> emissivity{};   // 0 to 1, in every band
    std::optional<double> reflectance{};  // 0 to 1, of all light; default: 1 - emissivity
    const Material* paint = nullptr;      // both by its spectra; null: none
    double warmer = 0.0;                  // [K] of its surfaces
};

/// Facets of a run: which of them change, and how much warmer all of them are.
struct ChangedFacets {
    std::vector<std::uint8_t> of_object;  // (facet) 1: of the object
    std::vector<float> warmer{};          // (facet) [K] effect of the change on heat; empty: none
};

struct ReshadedFrame {
    Frame frame;  // radiance, apparent temperature and planes of surfaces as they are then; without
                  // planes of the radiance's terms and of uncertain values
    std::size_t pixels = 0;    // that show the object
    double change = 0.0;       // [K] rms of apparent temperature over these
    double sum_rms = 0.0;      // [K] of the listed surfaces' sum from the picture's radiance,
    double sum_worst = 0.0;    //     over pixels that show the object
    std::size_t summed = 0;    //     and no surface that is not listed: these; 0: not known
    std::size_t unlisted = 0;  // of the object's pixels with surfaces that are not listed
    std::size_t mirrors = 0;   // of them with a mirror's light, which is left as it is
    /// [K] mean over the object of its change in balance with the radiation absorbed and emitted
    /// after it, by a film of 10 W/m2K and radiation: an estimate of the effect on heat.
    double heat_estimate = 0.0;
};

/// Changes the light of an object in a picture of one band, without solving heat:
///
///     radiance += Σ weight_k transmittance_k (ε' B(T') − ε B(T))
///               + Σ weight_k (ρ' − ρ) (sunlight_k, skylight_k, surroundings_k through the air)
///
/// Light that other surfaces reflect of it is not followed: second order in their reflectance.
/// Throws InputError if the picture lists no surfaces, or its band is not a range such as "8-12".
ReshadedFrame reshade(const Frame& frame, const ChangedFacets& facets, const SurfaceChange& change);

}  // namespace diurna
