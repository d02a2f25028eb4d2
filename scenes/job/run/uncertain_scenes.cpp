#include "scenes/job/run/uncertain_scenes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/run/found_heat.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/store/heat_content.hpp"
#include "scenes/job/store/inputs.hpp"
#include "thermal/field_difference.hpp"

namespace diurna {

namespace {

bool same_frames(const Prepared& a, const Prepared& b) {
    if (a.sequences.size() != b.sequences.size()) return false;
    for (std::size_t o = 0; o < a.sequences.size(); ++o) {
        if (a.sequences[o].frame != b.sequences[o].frame) return false;
    }
    return true;
}

/// Its heat as in a run of its own. Returns why it did not converge; "": it did.
std::string solve(const Prepared& base, const TemperatureField& field, ChangedScene& scene,
                  Progress& progress) {
    if (scene.prepared.movement.none() && heat_content(scene.prepared) == heat_content(base)) {
        scene.field = field;
        return "";
    }
    progress.stage(StageId::named, scene.key.empty()
                                       ? "heat balance with all uncertain values changed"
                                       : "heat balance with another " + scene.key);
    SceneHeat heat = scene_heat(scene.stages, run_inputs(scene.prepared.scene), progress,
                                base.plan.decisions.heat);
    scene.field = std::move(heat.result.temperature);
    return heat.report.not_converged;
}

/// [K] rms over facets and instants of the sum of all changes minus the change together.
double not_added(const TemperatureField& field, const ChangedScenes& scenes,
                 const TemperatureField& together) {
    double squares = 0.0;
    for (std::size_t i = 0; i < field.kelvin.size(); ++i) {
        double apart = double{field.kelvin[i]} - double{together.kelvin[i]};
        for (const auto& scene : scenes) {
            apart += double{scene->field.kelvin[i]} - double{field.kelvin[i]};
        }
        squares += apart * apart;
    }
    return std::sqrt(squares / double(field.kelvin.size()));
}

}  // namespace

ChangedScenes uncertain_scenes(const Prepared& base, const SceneWith& scene_with,
                               const std::shared_ptr<const StageStore>& store) {
    ChangedScenes scenes;
    for (const UncertainInput& one : base.scene.uncertain) {
        Prepared prepared =
            prepare(scene_with_settings(scene_with, {setting(one.key, one.one_sigma)}, one.where));
        if (prepared.world.surfaces().size() != base.world.surfaces().size() ||
            !same_frames(prepared, base)) {
            throw InputError(one.where,
                             one.key +
                                 " changes the mesh or the instants of pictures, so that pixels "
                                 "of the two runs do not correspond",
                             "run the scene a second time with the other value");
        }
        scenes.push_back(std::make_unique<ChangedScene>(one.key, std::move(prepared), store));
    }
    return scenes;
}

std::vector<std::string> solve_uncertain(const Prepared& base, const TemperatureField& field,
                                         const SceneWith& scene_with, ChangedScenes& scenes,
                                         Progress& progress) {
    std::vector<std::string> notes;
    const auto solve_one = [&](ChangedScene& scene) {
        if (std::string why = solve(base, field, scene, progress); !why.empty()) {
            notes.push_back(fmt::format("with another {}: {}",
                                        scene.key.empty() ? "value of each" : scene.key, why));
        }
    };
    std::vector<std::string> changes;
    std::vector<std::string> all;
    for (const auto& scene : scenes) {
        solve_one(*scene);
        changes.push_back(
            fmt::format("{} {:.2g} K", scene->key, difference_of(scene->field, field).rms));
    }
    std::string line = fmt::format(
        "uncertain values, one standard deviation each: temperatures change by {} (rms over facets "
        "and instants)",
        fmt::join(changes, ", "));
    if (scenes.size() > 1) {
        for (const UncertainInput& one : base.scene.uncertain) {
            all.push_back(setting(one.key, one.one_sigma));
        }
        ChangedScene together("", prepare(scene_with(all)), scenes.front()->stages.shared_store());
        solve_one(together);
        line += fmt::format("; their sum differs by {:.2g} K rms from the change by all together",
                            not_added(field, scenes, together.field));
    }
    notes.insert(notes.begin(), std::move(line));
    return notes;
}

}  // namespace diurna
