#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

// Sunlight that the air scatters changes over the sky by more than the functions of
// terrain/visibility/sky_basis.hpp follow: a fit over the whole sky is a few per cent of its mean
// off, which is little on open ground, but up to 60 % of what a facet has that sees a narrow piece
// of sky. From the facet's shares T_k of the functions it is found back where that piece lies:
//
//     w_i = p_i Σ λ_k f_k(ω_i),    Σ w_i f_k(ω_i) = T_k
//
// over fixed directions ω_i, p_i first the cosine to the facet, then w_i itself, between 0 and the
// cosine. Where p is the piece of sky itself the sum Σ w_i L(ω_i) is exact for every L.

/// Directions over half the sky, the other half its mirror image: rings of Gauss's points in the
/// sine of the elevation, each of sectors in azimuth from 0 to π.
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

/// How much a facet's narrow view counts: nothing where 0.9 of the hemisphere is sky, all below
/// 0.8; in between smoothly.
float narrowness(float sky_view);

/// - sky: T_k about the sun
/// - normal: of the facet, unit, with x towards the sun in plan
NarrowView narrow_view(const SkyVector& sky, const Eigen::Vector3f& normal);

}  // namespace diurna
