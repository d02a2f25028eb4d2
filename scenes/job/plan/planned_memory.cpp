#include "scenes/job/plan/planned_memory.hpp"

#include <algorithm>

#include "scenes/job/plan/plan_costs.hpp"

namespace diurna {

namespace {

/// View factors of a stage, and its copy of the facets that are solved.
double stage_bytes(double facets, double solved, bool part, const PlannedWork& work) {
    const double rows = plan_costs.row_entry * work.sky.entries;
    if (!part) return rows;
    return rows * (1.0 + solved / facets) + plan_costs.row_entry * work.check.entries +
           plan_costs.part_facet * (solved + work.check.patches);
}

}  // namespace

double planned_memory(const Scene& scene, const PlannedWork& work) {
    const double facets = work.facets;
    const double others = double(scene.uncertain.size());  // scenes with a value changed
    const double solved = work.solved;
    const bool part = !work.every || work.check.patches > 0.0;
    const double stage = stage_bytes(facets, solved, part, work);
    const double further_stages =
        (work.stages - 1.0) *
        (plan_costs.stage_facet * facets + plan_costs.stage_network_facet * work.networks + stage);
    const double columns = solved + work.check.patches;
    const double steps = work.days.steps_of_day;  // no more than a day is held
    const double sunlit = steps * work.days.sunlit / std::max(1.0, work.days.steps);
    const double heat =
        columns * (plan_costs.solved_facet + plan_costs.solved_step * steps +
                   plan_costs.sunlit_step * sunlit) +
        work.networks * (plan_costs.network_facet + plan_costs.network_facet_step * steps) + stage +
        solved / facets *
            (plan_costs.wet_facet * work.points.wet +
             plan_costs.freezing_facet * work.points.freezing) +
        (scene.output.fluxes ? 2.0 * 4.0 * work.values : 0.0);  // of the steps, and at instants
    const double views =  // that found the visible facets, for the pictures
        work.every ? 0.0 : std::min(plan_costs.most_views, work.pictures.standing_views);
    const double sampling = plan_costs.sampled_entry * work.sky.sampled;
    const double pictures = plan_costs.instrument_sample * work.samples +
                            work.pictures.largest_view + others * work.pictures.largest_other +
                            4.0 * work.values * (1.0 + others) +
                            (scene.observers.empty() ? 0.0 : plan_costs.pictured_facet * facets);
    return plan_costs.program + plan_costs.facet * facets +
           others * (plan_costs.other_scene + plan_costs.other_facet * facets) + further_stages +
           std::max({sampling, heat + views, pictures});
}

}  // namespace diurna
