#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/plan/sequence.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// One thing the job could compute, whether it will, and what leaving it out costs.
struct Decision {
    std::string what;
    bool computed = true;
    std::string why;
    double error = 0.0;      // bound on what leaving it out changes; 0 where it is exact
    std::string error_unit;  // "K", "W m-2", "W m-2 sr-1"
};

/// A stage of the job (scenes/run/job) and what it is thought to take [s].
struct PlannedStage {
    std::string name;
    double seconds = 0.0;
};

/// What a scene needs, worked out before anything is computed: as a database explains a query.
struct Plan {
    std::size_t facets = 0;
    std::vector<Instant> steps;         // step_instants() of the heat balance, ends included
    std::vector<Instant> sunlit_steps;  // those with the sun above the horizon: shadows are cast
    std::vector<Instant> frames;        // of all observers
    std::size_t sky_rays = 0, sun_rays = 0, view_rays = 0;
    std::size_t pixels = 0;        // of all observers' views
    std::size_t pictures = 0;      // frames of all observers, and
    std::size_t frame_pixels = 0;  // their pixels
    double memory = 0.0;           // [bytes] at its most
    double seconds = 0.0;          // sum of the stages: within 1.5 times on idle cores
    std::vector<PlannedStage> stages;
    std::vector<Decision> decisions;
};

/// A pure function of the scene, its facets and where its observers are (without these, nothing
/// seen in mirrors is counted). What each thing costs: scenes/plan/plan_costs.hpp.
Plan make_plan(const Scene& scene, const World& world, const Weather& weather,
               std::span<const Sequence> sequences = {});

/// The plan as the text `diurna plan` prints.
std::string describe(const Plan& plan);

}  // namespace diurna
