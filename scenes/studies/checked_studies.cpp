#include "scenes/studies/checked_studies.hpp"

#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/studies/crossover.hpp"
#include "scenes/studies/sensitivity.hpp"

namespace diurna {

void check_studies(const Prepared& prepared, const StudyRequest& request) {
    const SceneWith scene_with = request.scene_with();
    std::vector<Mistake> mistakes;
    for (const UncertainInput& one : prepared.scene.uncertain) {
        const auto found = mistake_with(scene_with, {setting(one.key, one.one_sigma)}, one.where);
        if (found) mistakes.push_back(*found);
    }
    if (!mistakes.empty()) throw InputError(std::move(mistakes));
    if (!prepared.scene.crossovers.empty()) check_crossovers(prepared, scene_with);
    for (const SensitivityInput& input : prepared.scene.sensitivities) {
        check_sensitivity(prepared, input, scene_with);
    }
}

}  // namespace diurna
