#pragma once

#include "scenes/job/plan/check_work.hpp"
#include "scenes/job/plan/heat_work.hpp"
#include "scenes/job/plan/picture_work.hpp"
#include "scenes/job/plan/sky_work.hpp"
#include "scenes/job/plan/solved_days.hpp"

namespace diurna {

/// What the estimates of time and memory are made of.
struct PlannedWork {
    SkyWork sky{};  // of one stage of moving objects
    SolvedDays days{};
    PictureWork pictures{};
    PointWork points{};
    CheckWork check{};
    double facets = 0.0;
    double networks = 0.0;  // facets of targets
    double solved = 0.0;    // facets that are solved
    bool every = true;      // facet is solved
    double stages = 1.0;    // of moving objects
    double values = 0.0;    // of temperatures and fluxes that are stored
    double samples = 0.0;   // of radiance, of the largest instrument's picture
};

/// Most memory at any time [bytes]: of view factors while they are sampled, of the heat balance, or
/// of pictures.
double planned_memory(const Scene& scene, const PlannedWork& work);

}  // namespace diurna
