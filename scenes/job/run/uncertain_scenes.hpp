#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenes/job/input/scene_with.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/stages.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A scene with one of its uncertain values (Scene::uncertain) one standard deviation away. Its
/// stages refer to it, so it stays where it is in memory.
struct ChangedScene {
    std::string key;
    Prepared prepared;
    Stages stages;
    TemperatureField field{};

    ChangedScene(std::string of, Prepared made, std::shared_ptr<const StageStore> store)
        : key(std::move(of)), prepared(std::move(made)), stages(prepared, std::move(store)) {}
    ChangedScene(const ChangedScene&) = delete;
    ChangedScene& operator=(const ChangedScene&) = delete;
};
using ChangedScenes = std::vector<std::unique_ptr<ChangedScene>>;

/// A scene once more for each of its uncertain values, for the planes sigma.BAND of its pictures
/// (scenes/job/run/sigma_planes.hpp). Throws InputError for a value that the scene does not accept,
/// and for one that changes its facets or the instants of its pictures. Nothing is solved.
///
/// - scene_with: reads the scene with other values
/// - store: cache that all share
ChangedScenes uncertain_scenes(const Prepared& base, const SceneWith& scene_with,
                               const std::shared_ptr<const StageStore>& store);

/// Solves their heat, each as in a run of its own, so that the pictures have the same bytes
/// whether the scene's own heat was solved, kept or taken from another folder; not at all where
/// the value changes nothing that the heat balance takes (scenes/job/store/heat_content.hpp).
/// Returns by how much each value changes temperatures; how far the sum of the changes is from the
/// change by all values together, which is solved as well and is the error of adding them; and
/// which heat balances did not converge: one line each.
///
/// - base: of the scene itself
/// - field: its temperatures
std::vector<std::string> solve_uncertain(const Prepared& base, const TemperatureField& field,
                                         const SceneWith& scene_with, ChangedScenes& scenes,
                                         Progress& progress);

}  // namespace diurna
