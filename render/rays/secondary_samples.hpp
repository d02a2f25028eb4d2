#pragma once

#include <span>
#include <vector>

#include "render/rays/secondary_rays.hpp"
#include "render/rays/walk.hpp"
#include "render/view/adaptive.hpp"

namespace diurna {

/// Adaptive sampling of pixels whose rays are followed: panes, nets, mirrors, plumes.
struct SecondarySampling {
    AdaptiveOptions options;
    std::span<const Appearance> appearances;  // as in cast_adaptive_view()
};

/// Approximate value of one sample of a pixel for each appearance [K]: transmitted and mirrored
/// shares of facets at 10 µm and their viewing angle, times what is behind and in them; the rest is
/// their own. Sky where a rough mirror's rays escape; plumes are transparent.
///
/// - sample: its secondary rays, each before those behind it
void sample_values(const SecondaryScene& scene, std::span<const SecondaryRay> sample,
                   std::span<const Appearance> appearances, std::vector<double>& value);

/// How many samples a pixel wants: `from`, doubled while the error of the worst appearance is above
/// the tolerance, at most `to`. The error of n samples is σ n^-3/4: they lie on grids over the
/// pixel and over lobes, where an edge meets √n of their n cells.
///
/// - values: (sample, appearance) of the first ones
int samples_wanted(std::span<const double> values, const SecondarySampling& sampling);

}  // namespace diurna
