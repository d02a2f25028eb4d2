#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/rays/plume.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/decisions.hpp"
#include "scenes/job/plan/instrument_cost.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/plan/stage_id.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// A stage of the job and its estimated time [s]; that of `report` includes labels.
struct PlannedStage {
    StageId stage;
    double seconds = 0.0;
    std::string of{};  // what it is spent on, where this is not plain from its name; else ""
};

/// The plan of a scene, made before anything is computed, like a database's query plan.
struct Plan {
    std::size_t facets = 0;
    std::vector<Instant> steps;         // step_instants() of the heat balance, ends included
    std::vector<Instant> sunlit_steps;  // those with the sun above the horizon: with shadows
    std::vector<Instant> frames;        // of all observers
    std::size_t stages_of_motion = 1;   // in which objects are at rest
    std::size_t sky_rays = 0, sun_rays = 0, view_rays = 0;
    std::size_t pixels = 0;        // of all observers' views
    std::size_t views = 0;         // of an observer at an instant, and
    std::size_t frame_pixels = 0;  // their pixels
    std::size_t pictures = 0;      // of a view in a band
    double memory = 0.0;           // [bytes] maximum
    double seconds = 0.0;          // sum of the stages: within 1.5 times on idle cores
    double finer_seconds = 0.0;    // a round with edges divided by 2, before its pictures
    std::vector<PlannedStage> stages;
    std::size_t observers = 0;
    std::vector<InstrumentCost> instruments;
    Decisions decisions;  // followed by the run
};

/// Depends only on the scene, its facets and the positions of its observers (without these
/// or its rays, mirrored pixels are not counted). Costs of each item:
/// scenes/job/plan/plan_costs.hpp.
///
/// - plumes: of the scene, at their places
/// - stages_of_motion: Movement::stage (scenes/job/world/movers.hpp)
Plan make_plan(const Scene& scene, const World& world, const Weather& weather,
               const RayScene* rays = nullptr, std::span<const Sequence> sequences = {},
               std::size_t stages_of_motion = 1, std::span<const Plume> plumes = {});

}  // namespace diurna
