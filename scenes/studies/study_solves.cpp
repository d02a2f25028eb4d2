#include "scenes/studies/study_solves.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "materials/base/number_of.hpp"

namespace diurna {

namespace {

StudySolves of_crossovers(const std::vector<CrossoverInput>& inputs) {
    std::set<std::pair<std::string, double>> numbers;
    bool refined = false;
    for (const CrossoverInput& input : inputs) {
        for (const UncertainInput& one : input.uncertain) numbers.insert({one.key, one.one_sigma});
        refined = refined || input.refined;
    }
    const std::size_t solves = 1 + numbers.size() + (refined ? 1 : 0);
    // The refined one has half the step.
    return {.kind = "crossover",
            .tables = inputs.size(),
            .solves = solves,
            .scenes = solves,
            .steps = double(solves) + (refined ? 1.0 : 0.0)};
}

/// Of one [[sensitivity]], without the scene's own solution.
void add_changed_scenes(const SensitivityInput& input, StudySolves& study) {
    const std::size_t numbers = input.uncertain.size();
    const std::size_t screened = input.trajectories * (numbers + 1);
    const bool combines = input.trajectories > 1 && !input.exact;
    const std::size_t middles = combines && input.levels > 2 ? numbers : 0;
    study.solves += 2 * numbers + middles + (combines ? 1 : screened);
    study.scenes += 2 * numbers + screened;
    study.may_be_more = study.may_be_more || combines;
}

}  // namespace

std::vector<StudySolves> study_solves(const Scene& scene) {
    std::vector<StudySolves> studies;
    const auto add_plain = [&](const char* kind, std::size_t tables) {
        if (tables == 0) return;
        studies.push_back({.kind = kind, .tables = tables, .solves = 1, .scenes = 1, .steps = 1.0});
    };
    add_plain("signature", scene.signatures.size());
    add_plain("detection", scene.detections.size());
    if (!scene.crossovers.empty()) studies.push_back(of_crossovers(scene.crossovers));
    add_plain("contrast", scene.contrasts.size());
    if (!scene.sensitivities.empty()) {
        StudySolves study{
            .kind = "sensitivity", .tables = scene.sensitivities.size(), .solves = 1, .scenes = 1};
        for (const SensitivityInput& input : scene.sensitivities) add_changed_scenes(input, study);
        study.steps = double(study.solves);
        studies.push_back(std::move(study));
    }
    return studies;
}

std::string describe(const std::vector<StudySolves>& studies, const Plan& plan) {
    if (studies.empty()) return "";
    double heat = 0.0, before = 0.0;  // [s]
    for (const PlannedStage& one : plan.stages) {
        if (one.stage == StageId::heat_balance) heat += one.seconds;
        if (one.stage < StageId::heat_balance) before += one.seconds;
    }
    std::string text = "studies of this scene, which a run does not compute:\n";
    for (const StudySolves& one : studies) {
        text += fmt::format("  diurna {:<12} {:>4}{}, at most about {:.0f} s besides pictures\n",
                            one.kind, number_of(one.solves, "solve"),
                            one.may_be_more ? " or more" : "", before + one.steps * heat);
    }
    return text +
           "  a solve that starts from a similar one takes less; pictures of the studied "
           "regions are not estimated\n";
}

std::size_t solves_of(const std::vector<StudySolves>& studies, const std::string& kind) {
    for (const StudySolves& one : studies) {
        if (one.kind == kind) return one.solves;
    }
    return 0;
}

}  // namespace diurna
