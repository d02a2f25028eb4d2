#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "terrain/facets.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

// The sky by direction, as a sum of sixteen functions of the unit vector (x east, y north, z up):
//
//     order 0   1, z, z², −ln z
//     order 1   (x, y) (1, z, z²)
//     order 2   (x² − y², 2xy) (1, z)
//     order 3   (x³ − 3xy², 3x²y − y³)
//
// the span of real spherical harmonics to the third degree (Sloan, Kautz & Snyder, SIGGRAPH 2002),
// with −ln z in place of z³: skies brighten towards the horizon with the thickness of the air. A
// facet's light from a sky Σ c_k f_k is π Σ c_k T_k, with T_k its share of each function,
//
//     T_k = 1/π ∫ f_k(ω) cosθ dω      over its visible sky, θ from its normal.
//
// T_0 is the sky view. A rotation about the vertical mixes only functions of one order.

inline constexpr std::size_t sky_functions = 16;
using SkyVector = std::array<float, sky_functions>;  // a value for each, in the order above

/// Functions that are even in y, as needed for a sky about a sun (or a plane tilted) towards x, in
/// the order above, and the order of each in azimuth.
inline constexpr std::size_t even_sky_functions = 10;
using EvenSkyVector = std::array<float, even_sky_functions>;
inline constexpr std::array<std::size_t, even_sky_functions> even_sky_function = {0, 1, 2,  3,  4,
                                                                                  6, 8, 10, 12, 14};
inline constexpr std::array<int, even_sky_functions> sky_order = {0, 0, 0, 0, 1, 1, 1, 2, 2, 3};

/// The functions in a direction [unit], z above 0 (below 1e-4 it counts as that).
SkyVector sky_functions_at(const Eigen::Vector3f& direction);

/// T_k of a plane with only the ground below the horizontal in front of it. Within 2e-5.
SkyVector open_plane(const Eigen::Vector3f& normal);
/// The same with an obstacle of one height all around that leaves this sky view, 0 to that of the
/// open plane (larger values count as that): the usual assumption if only a sky view is known.
/// Slow. Within 2e-4.
SkyVector plane_behind_ring(const Eigen::Vector3f& normal, double sky_view);

/// T_k for another sky view: scales the hidden part; if nothing was hidden, hides the sky just
/// above the horizon.
SkyShares with_sky_view(const SkyShares& shares, const Eigen::Vector3f& normal, double before,
                        double after);

/// T_k of a facet from its sky view and its shares; without shares, as plane_behind_ring().
SkyVector sky_of(const FacetViews& views, const FacetSet& facets, std::size_t facet);

/// T_k rotated about the vertical so that a direction in plan (unit) becomes x.
SkyVector about(const SkyVector& sky, const Eigen::Vector2f& towards);
/// The even ones of these.
EvenSkyVector even_part(const SkyVector& sky, const Eigen::Vector2f& towards);

}  // namespace diurna
