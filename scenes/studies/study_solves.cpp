#include "scenes/studies/study_solves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "materials/base/number_of.hpp"
#include "scenes/job/plan/plan_costs.hpp"
#include "scenes/job/world/stepping.hpp"

namespace diurna {

namespace {

// Times at which a difference is evaluated to find a crossing, and crossings of a pair in a band:
// those of morning and evening.
constexpr double evaluations = 6.0, crossings = 2.0;
// The plan's estimates are within 1.5 times of what a run takes, most within this.
constexpr double spare = 1.2;

StudySolves of_crossovers(const std::vector<CrossoverInput>& inputs, double instants) {
    std::set<std::pair<std::string, double>> numbers;
    std::set<std::pair<std::size_t, std::vector<std::string>>> views;
    bool refined = false;
    double found = 0.0, followed = 0.0;  // pictures that find crossings, and their shifts
    for (const CrossoverInput& input : inputs) {
        for (const UncertainInput& one : input.uncertain) numbers.insert({one.key, one.one_sigma});
        refined = refined || input.refined;
        views.insert({input.observer, input.bands});
        // Each evaluation has all bands.
        const double bands = double(input.bands.size());
        found += crossings * evaluations * bands * bands;
        followed += crossings * evaluations * bands * bands *
                    double(input.uncertain.size() + (input.refined ? 1 : 0));
    }
    for (const auto& [observer, bands] : views) found += instants * double(bands.size());
    const std::size_t solves = 1 + numbers.size() + (refined ? 1 : 0);
    // The refined one has half the step, and more samples.
    return {.kind = "crossover",
            .tables = inputs.size(),
            .solves = solves,
            .scenes = solves,
            .steps = double(solves) + (refined ? 1.0 : 0.0),
            .pictures = found + followed,
            .casts = double(views.size()) * (double(solves) + (refined ? 1.0 : 0.0))};
}

/// Of one [[sensitivity]], without the scene's own solution.
void add_changed_scenes(const SensitivityInput& input, double instants, StudySolves& study) {
    const std::size_t numbers = input.uncertain.size();
    const std::size_t screened = input.trajectories * (numbers + 1);
    const bool combines = input.trajectories > 1 && !input.exact;
    const std::size_t middles = combines && input.levels > 2 ? numbers : 0;
    study.solves += 2 * numbers + middles + (combines ? 1 : screened);
    study.scenes += 2 * numbers + middles + screened;
    const double changed = double(2 * numbers + screened);
    for (const SensitivityOutput& output : input.outputs) {
        if (output.figure == SensitivityOutput::Figure::temperature) continue;
        const bool crossover = output.figure == SensitivityOutput::Figure::crossover;
        study.pictures +=
            crossover ? instants + crossings * evaluations + evaluations * changed : 1.0 + changed;
        study.casts += 1.0 + changed;
    }
    study.may_be_more = study.may_be_more || combines;
}

StudySolves of_contrasts(const Scene& scene) {
    StudySolves study{.kind = "contrast",
                      .tables = scene.contrasts.size(),
                      .solves = 1,
                      .scenes = 1,
                      .steps = 1.0};
    for (const ContrastInput& input : scene.contrasts) {
        const double bands = double(input.bands.size());
        for (const std::size_t o : input.observers) {
            const ObserverInput& observer = scene.observers[o];
            const double frames = double(observer.frames.size());
            // The highest contrast of each target, again with half the samples.
            const double again = double(input.targets.size()) * bands;
            study.pictures += bands * (frames + again);
            study.casts += 1.0 + again / (observer.goes() ? std::max(1.0, frames) : 1.0);
        }
    }
    return study;
}

/// [s]
struct StudyCosts {
    double scene = 0.0;                // to read and build one
    double shadows = 0.0, heat = 0.0;  // of a solve; shadows with view factors
    double picture = 0.0;              // of a band at an instant
    double cast = 0.0;                 // of an observer's views
};

StudyCosts costs_of(const Plan& plan) {
    StudyCosts costs;
    double frames = 0.0, views = 0.0;
    for (const PlannedStage& one : plan.stages) {
        if (one.stage == StageId::heat_balance) costs.heat += one.seconds;
        if (one.stage == StageId::terrain) costs.scene += one.seconds;
        if (one.stage == StageId::sky_view || one.stage == StageId::shadows) {
            costs.shadows += one.seconds;
        }
        if (one.stage == StageId::views) views += one.seconds;
        if (one.stage == StageId::frames) frames += one.seconds;
    }
    const double pictures = double(plan.pictures);
    costs.picture = pictures > 0.0 ? frames / pictures : plan_costs.air_per_band;
    costs.cast = views / std::max(1.0, double(plan.observers));
    return costs;
}

}  // namespace

std::vector<StudySolves> study_solves(const Scene& scene) {
    std::vector<StudySolves> studies;
    const auto add_plain = [&](const char* kind, std::size_t tables) {
        if (tables == 0) return;
        studies.push_back({.kind = kind,
                           .tables = tables,
                           .solves = 1,
                           .scenes = 1,
                           .steps = 1.0,
                           .with_pictures = false});
    };
    const double instants = double(scene_steps(scene).size());
    add_plain("signature", scene.signatures.size());
    add_plain("detection", scene.detections.size());
    if (!scene.crossovers.empty()) studies.push_back(of_crossovers(scene.crossovers, instants));
    if (!scene.contrasts.empty()) studies.push_back(of_contrasts(scene));
    if (!scene.sensitivities.empty()) {
        StudySolves study{
            .kind = "sensitivity", .tables = scene.sensitivities.size(), .solves = 1, .scenes = 1};
        for (const SensitivityInput& input : scene.sensitivities)
            add_changed_scenes(input, instants, study);
        study.steps = double(study.solves);
        studies.push_back(std::move(study));
    }
    return studies;
}

std::string describe(const std::vector<StudySolves>& studies, const Plan& plan) {
    if (studies.empty()) return "";
    const StudyCosts costs = costs_of(plan);
    std::string text = "studies of this scene, which a run does not compute:\n";
    for (const StudySolves& one : studies) {
        const double seconds = spare * (double(one.scenes) * costs.scene + one.steps * costs.heat +
                                        (1.0 + one.steps) * costs.shadows +
                                        one.pictures * costs.picture + one.casts * costs.cast);
        text += fmt::format("  diurna {:<12} {:>4}{}, at most about {:.0f} s{}\n", one.kind,
                            number_of(one.solves, "solve"), one.may_be_more ? " or more" : "",
                            seconds, one.with_pictures ? "" : " besides pictures");
    }
    return text + "  a solve that starts from a similar one takes less\n";
}

std::size_t solves_of(const std::vector<StudySolves>& studies, const std::string& kind) {
    for (const StudySolves& one : studies) {
        if (one.kind == kind) return one.solves;
    }
    return 0;
}

}  // namespace diurna
