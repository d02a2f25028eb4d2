#include "scenes/studies/other_scene.hpp"

#include <fmt/format.h>

#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/run/heat.hpp"

namespace diurna {

namespace {

Scene every_step(Scene scene) {
    scene.time.every_step = true;
    return scene;
}

}  // namespace

std::string setting(const std::string& key, double value) {
    return fmt::format("{}={}", key, value);
}

void check_settings(const SceneWith& scene_with, const std::vector<std::string>& settings,
                    const std::string& where) {
    try {
        scene_with(settings);
    } catch (const InputError& error) {
        const Mistake& found = error.mistakes().front();
        throw InputError(where, fmt::format("{}: {}", found.where, found.problem), found.hint);
    }
}

OtherScene::OtherScene(Scene scene, Study& study)
    : prepared(prepare(every_step(std::move(scene)))), stages(prepared) {
    if (prepared.world.facets.size() != study.stages().scene().world.facets.size()) {
        throw InputError(prepared.scene.file.string(),
                         "this uncertain value changes the facets of the ground, which alone would "
                         "change the results");
    }
    SpanResult result = solve_scene(stages, study.progress());
    not_converged = diurna::not_converged(result.report);
    field = std::move(result.temperature);
}

}  // namespace diurna
