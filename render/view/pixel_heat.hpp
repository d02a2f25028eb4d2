#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// (facet that rays know) [K] By how much it is warmer in the whole sun than in the shade: slope of
/// the straight line (least squares) through shares of the sun and temperatures of it and of those
/// about it that have a corner in common, lie in its plane to 10° and are of its material. Held
/// within 0 and what keeps both ends within these facets' temperatures; of thin sheets, which
/// follow the sun within minutes, within what the sun can warm them, as of large facets none may be
/// wholly in the shade. 0 where `crossed` is. What comes out of a shadow counts as warm as what is
/// long out of it: only the present sun is known.
///
/// - crossed: (facet) of the first so many
/// - share: (facet) of the sun; temperature: (facet) [K]
std::vector<float> kelvins_of_sun(const FacetSet& facets, std::span<const std::uint8_t> crossed,
                                  std::span<const float> share, std::span<const float> temperature,
                                  std::span<const float> most);

/// (facet) [K] By how much the whole sun can warm facets that follow it at once, whose layers hold
/// less than 15 kJ m⁻² K⁻¹ (ten minutes at 25 W m⁻² K⁻¹): absorbed sunlight of 1000 W m⁻² over what
/// its faces send by heat radiation and by a film of 4 W m⁻² K⁻¹ or the constant one it has. 0 of
/// all others.
std::vector<float> most_kelvins_of_sun(const FacetSet& facets, const MaterialLibrary& materials,
                                       const Eigen::Vector3d& to_sun,
                                       std::span<const float> temperature);

/// Sets how much warmer than their facets' mean pixels are: that times their share of the sun less
/// the facet's, so that the facet's mean stays.
///
/// Levels of a texture go by those of their own material.
///
/// - temperature: (facet) [K]
void set_pixel_heat(const View& view, const SunOverFacets& sun, const MaterialLibrary& materials,
                    std::span<const float> temperature, const TextureLevels* levels,
                    PixelSun& pixels);

}  // namespace diurna
