#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// (facet known to rays) [K] Temperature difference between full sun and shade: slope of the line
/// (least squares) through sunlit shares and temperatures of the facet and of its neighbours with a
/// common corner, in its plane to 10° and of its material. Limited to at least 0 and to the range
/// of these facets' temperatures; for thin sheets, which follow the sun within minutes, to the
/// possible effect of the sun, as of large facets none may be entirely in the shade. 0 unless
/// `crossed`.
///
/// - crossed: (facet) for the first ones
/// - share: (facet) of the sun, past or present (render/view/past_sun.hpp); temperature: (facet)
/// [K]
std::vector<float> kelvins_of_sun(const FacetSet& facets, std::span<const std::uint8_t> crossed,
                                  std::span<const float> share, std::span<const float> temperature,
                                  std::span<const float> most);

/// Whether a surface responds immediately to the sun: it has no layers, or they hold less than
/// 15 kJ m⁻² K⁻¹ (ten minutes at 25 W m⁻² K⁻¹).
bool follows_at_once(const ThermalSurface& surface);

/// (facet) [K] Largest effect of full sun on facets that respond immediately, with layers of less
/// than 15 kJ m⁻² K⁻¹ (ten minutes at 25 W m⁻² K⁻¹): absorbed sunlight of 1000 W m⁻² over the heat
/// transfer of its faces by radiation and by a film of 4 W m⁻² K⁻¹, or its constant film. 0 for all
/// others.
std::vector<float> most_kelvins_of_sun(const FacetSet& facets, const MaterialLibrary& materials,
                                       const Eigen::Vector3d& to_sun,
                                       std::span<const float> temperature);

/// Sets the temperature difference of pixels from their facets' mean: that slope times the pixel's
/// share of the sun minus the facet's, so that the facet's mean is unchanged. Shares are those over
/// the hours before where SunOverFacets::past has them.
///
/// Levels of a texture use the slopes of their own material.
///
/// - temperature: (facet) [K]
void set_pixel_heat(const View& view, const SunOverFacets& sun, const MaterialLibrary& materials,
                    std::span<const float> temperature, const TextureLevels* levels,
                    PixelSun& pixels);

}  // namespace diurna
