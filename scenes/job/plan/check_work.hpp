#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/decisions.hpp"
#include "scenes/job/plan/solved_days.hpp"

namespace diurna {

inline constexpr int check_rays = 4096;       // of a patch, to sky and surroundings
inline constexpr int check_sun_samples = 64;  // to the sun's disc

/// Work of a run's surface check (scenes/job/run/check_points.hpp): places in pictures, each solved
/// as a small patch and as its whole facet.
struct CheckWork {
    double patches = 0.0;
    double seconds = 0.0;  // of the processor, the heat of the patches included
    double entries = 0.0;  // of the patches' view factors, at one stage
};

/// At most: places on targets, panes and copies are not checked.
///
/// - stages: of moving objects, 1 without motion
CheckWork check_work(const Scene& scene, const HeatDecision& decision, double stages,
                     const SolvedDays& days);

}  // namespace diurna
