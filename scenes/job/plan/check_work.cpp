#include "scenes/job/plan/check_work.hpp"

#include <algorithm>

#include "scenes/job/plan/heat_bands.hpp"
#include "scenes/job/plan/plan_costs.hpp"

namespace diurna {

namespace {

constexpr double patches_per_place = 2.0;
constexpr double entries_of_patch = 60.0;  // other facets that one sees

}  // namespace

CheckWork check_work(const Scene& scene, const HeatDecision& decision, double stages,
                     const SolvedDays& days) {
    const bool looked_at = std::any_of(
        scene.observers.begin(), scene.observers.end(), [&](const ObserverInput& observer) {
            return !observer.frames.empty() && !heat_bands(scene, observer).empty();
        });
    if (!looked_at || decision.check_points <= 0) return {};
    const double patches = patches_per_place * decision.check_points;
    return {.patches = patches,
            .seconds =
                patches * (plan_costs.patch_ray * check_rays * stages +
                           plan_costs.patch_sun_ray * check_sun_samples * days.sunlit +
                           plan_costs.patch_day * days.days + plan_costs.patch_step * days.steps),
            .entries = entries_of_patch * patches};
}

}  // namespace diurna
