#pragma once

#include <span>
#include <vector>

#include "render/rays/plume.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// Adds a sample's secondary rays to those of its pixel. Hits that several samples have after the
/// same secondary rays, in the same way, are stored once, with the sum of their weights and their
/// mean range, height, angle, direction and chord: the radiance is linear in these within a pixel.
///
/// They stay separate if merging would be visible: chords through a plume that differ from the mean
/// by more than 0.01 of optical depth (otherwise the mean's transmittance is within 5e-5, 2 mK for
/// a plume 40 K from its background), sky more than 2 mrad from the mean direction, hits of
/// mirrors' rays 30 mrad from theirs (in azimuth 150 mrad, in elevation the same near the horizon,
/// a fifth of it more above), and facets more than 6 % from the mean range or, except in mirrors, 6
/// mrad from the mean direction. Within 2 mK of unmerged samples
/// (tests/render/secondary_rays_test.cpp).
void add_sample(std::span<const SecondaryRay> sample, const PlumeScene& plumes,
                std::vector<SecondaryRay>& pixel);

}  // namespace diurna
