#pragma once

#include <span>

#include "materials/radiation/band.hpp"
#include "render/light/radiance.hpp"
#include "render/rays/hops.hpp"
#include "render/rays/plume.hpp"

namespace diurna {

/// Band radiance [W m⁻² sr⁻¹] of a pixel's hops, hop by hop and node by node: the reference that
/// the tables of HopLight are measured against. `pixel` counts the pixels of `hops`. The program
/// itself does not call it; the tests do.
double hop_radiance(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes,
                    const Band& band, const RadianceInput& input,
                    const ScatteredSun* scattered = nullptr);

}  // namespace diurna
