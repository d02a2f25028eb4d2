#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/input/scene_with.hpp"
#include "scenes/job/plan/chosen_pictures.hpp"
#include "scenes/job/plan/job_report.hpp"
#include "scenes/job/plan/plan.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

struct JobOptions {
    std::filesystem::path out = "out";
    std::vector<std::string> settings{};         // "key=value" given on the command line
    std::shared_ptr<const StageStore> stages{};  // cache of earlier results; null: none
    PictureChoice pictures{};                    // those to render; others are skipped
    std::vector<std::filesystem::path> parts{};  // folders of runs that have them all together
    std::filesystem::path from{};  // folder of a run with the same inputs that has temperatures
    std::filesystem::path temperatures{};  // file to be used instead of a heat balance
    bool resume = false;                   // retain files of an earlier run with the same inputs
    double max_memory = 0.0;  // [bytes] limit for the plan; 0: free memory of the machine
    /// Reads the scene with other values, for Scene::uncertain; null: no planes sigma.BAND, which
    /// the report says.
    SceneWith scene_with{};
    ProgressTo progress{};
};

/// Throws InputError if run_job() would refuse its folder, by what is known before the scene's
/// files are read. Writes nothing.
void check_job_folder(const Scene& scene, const JobOptions& options);

/// The whole job: plan, build, solve, render, write. Results are the same bytes for any number of
/// threads. A killed run leaves only complete files and can be resumed.
JobReport run_job(Scene scene, const JobOptions& options);

}  // namespace diurna
