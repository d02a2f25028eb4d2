#include "scenes/job/plan/plan_text.hpp"

#include <fmt/format.h>

#include "materials/base/number_of.hpp"
#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

std::string listed(const std::vector<std::string>& kinds) {
    return kinds.empty() ? "none" : fmt::format("{}", fmt::join(kinds, ", "));
}

PlanRow solved_facets(const HeatDecision& heat) {
    if (!heat.every_facet.empty()) {
        return {.what = "heat of facets that no picture needs",
                .computed = true,
                .why = "every facet is solved: " + heat.every_facet,
                .error = 0.0,
                .error_unit = "K"};
    }
    return {.what = "heat of facets that no picture needs",
            .computed = false,
            .why = "they get the temperatures of representative facets (tolerance_K)",
            .error = heat.tolerance,
            .error_unit = "K"};
}

std::string lit_by(const PictureLight& light) {
    std::vector<std::string> parts;
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0) parts.push_back(fmt::format("{} {}", number_of(count, "view"), what));
    };
    add(light.sun, "by the sun");
    add(light.moon, "by the moon");
    add(light.neither, "by neither, from emission and the sky's longwave alone");
    return fmt::format("{}", fmt::join(parts, ", "));
}

void add_instrument(const InstrumentCost& cost, std::vector<PlanRow>& rows) {
    rows.push_back(
        {.what = "instrument " + cost.name,
         .computed = true,
         .why = cost.oversampling.why + fmt::format("; {} rays per sample", cost.samples),
         .error = 0.0,
         .error_unit = "W m-2 sr-1"});
    if (cost.left_out.empty()) return;
    rows.push_back(
        {.what = "stages of instrument " + cost.name,
         .computed = false,
         .why = fmt::format("disabled by its settings: {}", fmt::join(cost.left_out, ", ")),
         .error = 0.0,
         .error_unit = "W m-2 sr-1"});
}

}  // namespace

std::vector<PlanRow> plan_rows(const Plan& plan) {
    const Decisions& decisions = plan.decisions;
    const PictureLight& light = decisions.light;
    const std::size_t dark = plan.steps.size() - plan.sunlit_steps.size();
    std::vector<PlanRow> rows{
        {.what = "shadows",
         .computed = !plan.sunlit_steps.empty(),
         .why =
             fmt::format("the sun is up in {} of {} steps; the other {} need no rays; a shadow "
                         "edge within a step is located to 20 s, so the error lasts a few minutes",
                         plan.sunlit_steps.size(), plan.steps.size(), dark),
         .error = 0.4,
         .error_unit = "K"},
        {.what = "heat balance step by step",
         .computed = true,
         .why = "modal solution per material, rms over facets and instants (bench/results)",
         .error = 0.003,
         .error_unit = "K"},
        solved_facets(decisions.heat),
        {.what = "evaporation",
         .computed = !decisions.evaporating.empty() || !decisions.holding_water.empty(),
         .why = fmt::format("moist by themselves: {}; wet where there is rain, dew, hoar or snow: "
                            "{}; without water (skipped): {}",
                            listed(decisions.evaporating), listed(decisions.holding_water),
                            listed(decisions.dry)),
         .error = 0.0,
         .error_unit = "W m-2"},
        {.what = "exchange between facets",
         .computed = true,
         .why = "only facets whose rays meet other facets; open ground has no row",
         .error = 0.0,
         .error_unit = "W m-2"},
    };
    if (light.sun + light.moon + light.neither > 0) {
        rows.push_back({.what = "reflected sun or moon",
                        .computed = light.sun + light.moon > 0,
                        .why = lit_by(light),
                        .error = 0.0,
                        .error_unit = "W m-2 sr-1"});
        rows.push_back({.what = "radiance of unseen facets",
                        .computed = false,
                        .why = "not in any pixel; their temperatures still heat visible facets",
                        .error = 0.0,
                        .error_unit = "W m-2 sr-1"});
        const std::size_t cast_once = decisions.views_cast_once;
        rows.push_back(
            {.what = "rays per frame",
             .computed = cast_once == 0,
             .why = cast_once == plan.observers
                        ? "each observer's view is traced once for all frames"
                        : fmt::format("{} of {} are fixed: their views are traced once for all "
                                      "frames, the others' for each frame",
                                      cast_once, number_of(plan.observers, "observer")),
             .error = 0.0,
             .error_unit = "W m-2 sr-1"});
        rows.push_back(
            {.what = "rounds of finer settings",
             .computed = decisions.rounds > 0,
             .why = decisions.rounds > 0
                        ? fmt::format(
                              "at most {} where the surface check finds more than "
                              "tolerance_K: the heat balance again, with more rays or edges "
                              "divided by up "
                              "to 2; one with all edges divided by 2 takes about {:.0f} s more, "
                              "which are not in the time above",
                              decisions.rounds, plan.finer_seconds)
                        : "rounds = 0, tolerance_K = 0, or no surface check",
             .error = 0.0,
             .error_unit = "K"});
        const std::size_t uncertain = decisions.uncertain;
        rows.push_back({.what = "standard deviation as planes",
                        .computed = uncertain > 0,
                        .why = uncertain == 0
                                   ? "no [[uncertain]] values"
                                   : fmt::format("heat and pictures once more for each of {}",
                                                 number_of(uncertain, "uncertain value")),
                        .error = 0.0,
                        .error_unit = "K"});
        rows.push_back({.what = "terms of the radiance as planes",
                        .computed = decisions.terms,
                        .why = decisions.terms ? "requested by observer.terms"
                                               : "not requested by observer.terms",
                        .error = 0.0,
                        .error_unit = "W m-2 sr-1"});
    }
    for (const InstrumentCost& cost : plan.instruments) add_instrument(cost, rows);
    return rows;
}

std::string picture_counts(const Plan& plan) {
    return fmt::format("{}, {}, {}", number_of(plan.views, "view"),
                       number_of(plan.pictures, "picture"),
                       number_of(plan.frames.size(), "instant"));
}

std::string describe(const Plan& plan) {
    std::string text = fmt::format(
        "facets      {:>12}\n"
        "steps       {:>12}   {} with the sun up\n"
        "views       {:>12}   {:.4g} pixels; an observer at an instant\n"
        "pictures    {:>12}   a view in a band; at {}\n"
        "rays        {:>12.4g}   sky {:.3g}, sun {:.3g}, views {:.3g}\n"
        "memory      {:>9.0f} MB  estimated\n"
        "time        {:>10.1f} s   estimated, {}\n",
        plan.facets, plan.steps.size() - 1, plan.sunlit_steps.size(), plan.views,
        double(plan.frame_pixels), plan.pictures, number_of(plan.frames.size(), "instant"),
        static_cast<double>(plan.sky_rays + plan.sun_rays + plan.view_rays),
        static_cast<double>(plan.sky_rays), static_cast<double>(plan.sun_rays),
        static_cast<double>(plan.view_rays), plan.memory / 1e6, plan.seconds,
        number_of(thread_count(), "thread"));
    for (const PlannedStage& stage : plan.stages) {
        text += fmt::format("  {:<18} {:>6.1f} s{}{}\n", name_of(stage.stage), stage.seconds,
                            stage.of.empty() ? "" : "   ", stage.of);
    }
    for (const PlanRow& row : plan_rows(plan)) {
        text +=
            fmt::format("{:<9} {:<34} {} (error {:g} {})\n", row.computed ? "computed" : "skipped",
                        row.what, row.why, row.error, row.error_unit);
    }
    return text;
}

}  // namespace diurna
