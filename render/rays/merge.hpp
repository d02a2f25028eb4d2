#pragma once

#include <span>
#include <vector>

#include "render/rays/plume.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// Adds a sample's secondary rays to those of its pixel. What several samples meet after the same
/// secondary rays, the same way, is kept once, with their weights' sum and their mean range,
/// height, angle, direction and chord: what it sends is linear in these within a pixel.
///
/// Where that would show they stay apart: chords through a plume that differ from the mean by more
/// than 0.01 of optical depth (their mean's transmittance is within 5e-5 then, and 2 mK of a plume
/// 40 K from what is behind it), sky more than 2 mrad from the mean direction, what
/// mirrors' rays meet 30 mrad from theirs (in azimuth 150 mrad, in height as much as near the
/// horizon, a fifth of it more above), and facets more than 6 % from the mean range or, but in
/// mirrors, 6 mrad from the mean direction. Within 2
/// mK of samples kept one by one (tests/render/secondary_rays_test.cpp).
void add_sample(std::span<const SecondaryRay> sample, const PlumeScene& plumes,
                std::vector<SecondaryRay>& pixel);

}  // namespace diurna
