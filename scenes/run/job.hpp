#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/plan/plan.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

struct JobOptions {
    std::filesystem::path out = "out";
    std::vector<std::string> settings;  // "key=value" given on the command line
    bool resume = false;                // keep what an earlier run with the same inputs has left
    ProgressStyle progress = ProgressStyle::silent;
};

/// Everything a job knows once the scene stands: place, triangles, weather, what is to be done.
struct Prepared {
    Scene scene;
    World world;
    RayScene rays;
    Weather weather;
    std::vector<Observer> observers;  // placed above the ground, in the order of the scene
    Plan plan;
    std::vector<Plume> plumes;       // placed likewise
    std::vector<std::string> notes;  // what a reader should know of the elevation data
};

/// Builds the world and checks what can be checked before anything is computed or written.
Prepared prepare(Scene scene);

/// What a run did, for the report and for tests.
struct JobReport {
    Plan plan;
    TinCheck ground_check;
    std::size_t posts = 0;
    SolveReport solve;
    bool solved = false;              // false: temperatures were kept from an earlier run
    std::size_t frames_rendered = 0;  // the others were kept
    std::vector<std::string> files;   // written or kept, relative to the folder
    std::vector<Progress::Stage> stages;
    std::vector<std::string> notes;  // what was modelled for want of data
};

/// The whole way: plan, build, solve, render, write. Results are the same bytes for any number
/// of threads. A killed run leaves whole files only and can be resumed.
JobReport run_job(Scene scene, const JobOptions& options);

/// What each facet sees: the ground's sky by the march over the raster, all else by rays.
FacetViews scene_sky_view(const Prepared& prepared);

/// How the heat balance of a scene is stepped.
SolveOptions scene_solve_options(const Scene& scene);

/// Who is in the sun at each of its steps, and when within them shadows' edges pass.
SunExposure scene_sun_exposure(const Prepared& prepared, Progress& progress);

/// Shadows and heat balance: temperatures alone.
SolveResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress);

}  // namespace diurna
