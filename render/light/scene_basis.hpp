#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/light/band_channels.hpp"
#include "render/light/interreflection.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/spectral_basis.hpp"

namespace diurna {

/// Modes for all that the surfaces of a scene send out in a band: black bodies good to 0.1 mK at
/// the scene's cold end, and what a facet seen reflects of its surroundings to 0.2 mK, or 1e-7 of
/// the sunlight that a surface reflects, whichever is more.
SpectralBasis scene_basis(const Band& band, std::span<const NodeOptics> optics,
                          const std::array<Light, 3>& light, const LitFacets::Worth& worth,
                          const TemperatureExtent& extent);

/// Radiance per channel that stands for a scene's surfaces: black bodies as cold and as hot as it,
/// a mirror of a cold sky, and by day a white surface in the sun.
std::vector<std::vector<float>> probes(const Band& band, const Channels& channels,
                                       const RadianceInput& input, const Light& light,
                                       const TemperatureExtent& extent);

/// Bounces, with the worth of sunlight and of the scene's spread in kelvins at its cold end.
BounceOptions bounce_options(const Band& band, const TemperatureExtent& extent, const Light& light,
                             bool scattered, int bounces, double tolerance);

/// Bound on the radiance [W m⁻² sr⁻¹] that goes on after the bounces followed, surroundings left
/// out for being below tolerance included.
double left_over(const Band& band, const TemperatureExtent& extent, const Light& light,
                 bool scattered, const LitFacets::Worth& worth, int bounces,
                 const BounceOptions& options);

}  // namespace diurna
