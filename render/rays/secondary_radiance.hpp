#pragma once

#include <span>

#include "materials/radiation/band.hpp"
#include "render/light/radiance.hpp"
#include "render/rays/plume.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// Band radiance [W m⁻² sr⁻¹] of a pixel's secondary rays, one by one and node by node: the
/// reference for the tables of SecondaryLight. `pixel` counts the pixels of `secondary rays`. Used
/// by the tests only.
double secondary_radiance(const SecondaryRays& secondary_rays, std::size_t pixel,
                          std::span<const Plume> plumes, const Band& band,
                          const RadianceInput& input, const ScatteredSun* scattered = nullptr);

}  // namespace diurna
