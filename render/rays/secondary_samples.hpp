#pragma once

#include <span>
#include <vector>

#include "render/rays/secondary_rays.hpp"
#include "render/rays/walk.hpp"
#include "render/view/adaptive.hpp"

namespace diurna {

/// Samples by need for pixels whose rays are followed: panes, nets, mirrors, plumes.
struct SecondarySampling {
    AdaptiveOptions options;
    std::span<const Appearance> appearances;  // as of cast_adaptive_view()
};

/// What one sample of a pixel shows of each appearance, roughly [K]: what facets let through and
/// mirror at 10 µm and the angle they are met at, times what lies behind and in them; the rest is
/// their own. Where a rough mirror's rays escape, the sky; plumes let everything through.
///
/// - sample: its secondary rays, one before those behind it
void sample_values(const SecondaryScene& scene, std::span<const SecondaryRay> sample,
                   std::span<const Appearance> appearances, std::vector<double>& value);

/// How many samples a pixel wants: `from`, doubled while the error of the worst appearance is above
/// the tolerance, at most `to`. The error of n samples is σ n^-3/4: they lie on grids over the
/// pixel and over lobes, where an edge meets √n of their n cells.
///
/// - values: (sample, appearance) of the first ones
int samples_wanted(std::span<const double> values, const SecondarySampling& sampling);

}  // namespace diurna
