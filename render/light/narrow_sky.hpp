#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

// Scattered sunlight varies more over the sky than the functions of
// terrain/visibility/sky_basis.hpp can represent: a fit over the whole sky is off by a few per cent
// of its mean, which is little on open ground, but up to 60 % for a facet that sees a narrow part
// of the sky. That part's position is reconstructed from the facet's shares T_k of the functions:
//
//     w_i = p_i Σ λ_k f_k(ω_i),    Σ w_i f_k(ω_i) = T_k
//
// over fixed directions ω_i, p_i first the cosine to the facet, then w_i itself, between 0 and the
// cosine. If p is the visible part of the sky itself, the sum Σ w_i L(ω_i) is exact for every L.

/// Directions over half the sky (the other half is its mirror image): rings at Gauss points in the
/// sine of the elevation, each with sectors in azimuth from 0 to π.
inline constexpr std::size_t sky_rings = 6, sky_sectors = 12,
                             sky_directions = sky_rings * sky_sectors;
struct HalfSky {
    std::array<double, sky_directions> up;           // sine of the elevation
    std::array<double, sky_directions> azimuth;      // [rad] 0 to π
    std::array<double, sky_directions> ring_weight;  // of the ring in ∫ d up
};
/// (ring, sector)
const HalfSky& half_sky();

/// Shares of a facet's view by direction of half_sky, both halves together; their sum is the sky
/// view.
using NarrowView = std::array<float, sky_directions>;

/// Weight of a facet's narrow view: 0 if 0.9 of the hemisphere is sky, 1 below 0.8; smooth
/// between.
float narrowness(float sky_view);

/// - sky: T_k relative to the sun
/// - normal: of the facet, unit, with x towards the sun in plan
NarrowView narrow_view(const SkyVector& sky, const Eigen::Vector3f& normal);
/// The same for many facets at once, some tens: eight side by side.
void narrow_views(std::span<const SkyVector> sky, std::span<const Eigen::Vector3f> normal,
                  std::span<NarrowView> view);

}  // namespace diurna
