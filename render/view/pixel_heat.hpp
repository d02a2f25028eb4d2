#pragma once

#include <span>
#include <vector>

#include "render/view/pixel_sun.hpp"

namespace diurna {

/// (facet that rays know) [K] By how much it is warmer in the whole sun than in the shade: slope of
/// the straight line (least squares) through shares of the sun and temperatures of it and of those
/// about it that have a corner in common, lie in its plane to 10° and are of its material. Held
/// within 0 and what keeps both ends within these facets' temperatures. 0 where `crossed` is.
/// What comes out of a shadow counts as warm as what is long out of it: only the present sun is
/// known.
///
/// - share: (facet) of the sun; temperature: (facet) [K]
std::vector<float> kelvins_of_sun(const FacetSet& facets, std::span<const std::uint8_t> crossed,
                                  std::span<const float> share, std::span<const float> temperature);

/// Sets how much warmer than their facets' mean pixels are: that times their share of the sun less
/// the facet's, so that the facet's mean stays.
///
/// - temperature: (facet) [K]
void set_pixel_heat(const View& view, const SunOverFacets& sun, std::span<const float> temperature,
                    const TextureLevels* levels, PixelSun& pixels);

}  // namespace diurna
