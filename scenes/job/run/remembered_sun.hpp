#pragma once

#include <span>
#include <vector>

#include "render/view/past_sun.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// The sun over a scene in the four hours before a picture, for temperatures within facets:
/// (T55) of docs/theory.md.
struct RememberedSun {
    PastSun past{};
    /// (lag)(surface) Sunlit shares at four moments, 6 to 165 minutes earlier; empty: none.
    std::vector<std::vector<float>> earlier{};
    /// (material)(moment) Weights of the present and of those, sum 1; all of the present where a
    /// surface follows the sun at once.
    std::vector<std::vector<float>> weight{};

    bool empty() const { return earlier.empty(); }
    std::vector<std::span<const float>> moments() const { return {earlier.begin(), earlier.end()}; }
};

/// For surfaces that objects can shade: those of objects, and ground of which objects hide more
/// than 0.2 %; the others follow the present sun. A surface remembers by its step response with the
/// film of the wind at the instant; ground of leaves and ground side by side (canopy) and thin
/// sheets follow at once. Nothing while the sun is down, and in scenes with moving objects, whose
/// earlier shadows were elsewhere.
///
/// - fraction: (surface) sunlit share at the instant
/// - wanted: surfaces on or beside visible facets; empty: nothing
RememberedSun remembered_sun(const Prepared& prepared, const FacetViews& views,
                             std::span<const float> fraction, std::span<const SurfaceId> wanted,
                             Instant instant);

}  // namespace diurna
