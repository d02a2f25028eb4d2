#pragma once

#include <span>

#include "materials/band.hpp"
#include "render/hops.hpp"
#include "render/radiance.hpp"

namespace diurna {

/// Band radiance [W m⁻² sr⁻¹] of a pixel's hops, hop by hop and node by node: the reference that
/// the tables of HopLight are measured against. `pixel` counts the pixels of `hops`.
double hop_radiance(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes,
                    double observer_height, const Band& band, const RadianceInput& input,
                    const SunField* scattered = nullptr);

}  // namespace diurna
