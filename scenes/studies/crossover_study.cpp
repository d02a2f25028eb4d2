#include "scenes/studies/crossover_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/number_of.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/studies/band_words.hpp"
#include "scenes/studies/crossover_files.hpp"
#include "scenes/studies/study_solves.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

std::string reported(const CrossoverInput& input, const TimedCrossing& one, double utc_offset) {
    const std::string& warmer = one.first_warmer_after ? input.first.name : input.second.name;
    std::string text = fmt::format("  {}  ", format_local(one.when, utc_offset));
    if (one.kind == ZeroCrossing::Kind::touches) {
        text += fmt::format("touches: {} remains warmer, by at least {:.2g} K", warmer,
                            std::abs(one.least));
    } else if (one.kind == ZeroCrossing::Kind::jumps) {
        text += fmt::format("{} is warmer afterwards (step)", warmer);
    } else {
        text += fmt::format("{} is warmer afterwards, {:+.2f} K/h", warmer, 3600.0 * one.slope);
    }
    if (one.kind != ZeroCrossing::Kind::touches && !input.uncertain.empty()) {
        text += fmt::format(", +- {:.1f} min (one standard deviation, 68 %)", one.sigma / 60.0);
    }
    if (one.refined) text += fmt::format(", {:+.0f} s by refinement", *one.refined);
    for (const std::string& key : gone_with(input, one)) text += ", absent with " + key;
    return text + "\n";
}

/// Of a band without a crossing: that uncertain numbers shift none.
std::string without_effect(const CrossoverInput& input) {
    if (input.uncertain.empty()) return "";
    std::vector<std::string> keys;
    for (const UncertainInput& one : input.uncertain) keys.push_back(one.key);
    return fmt::format("; no crossover that {} could shift", fmt::join(keys, ", "));
}

std::string reported(const CrossoverInput& input, const CrossoverReport& report,
                     double utc_offset) {
    std::string text;
    for (const CrossoverDay& day : report.band) {
        const double hours = seconds_between(day.instant.front(), day.instant.back()) / 3600.0;
        text += fmt::format(
            "{} {}: {} and {}, {} and {} pixels: contrast below {:g} K for {:.1f} of {:.1f} h\n",
            input.name, band_words(day.band), input.first.name, input.second.name,
            report.first_pixels, report.second_pixels, input.threshold, day.lost / 3600.0, hours);
        if (day.crossing.empty()) {
            text += fmt::format(
                "  no crossover: {} is warmer throughout; smallest difference {:.2f} K at {}{}\n",
                day.nearest > 0.0 ? input.first.name : input.second.name, day.worst_least,
                format_local(day.nearest_at, utc_offset), without_effect(input));
        }
        for (const TimedCrossing& one : day.crossing) text += reported(input, one, utc_offset);
    }
    return text;
}

/// Notes of one crossover that its figures alone would not tell.
std::vector<std::string> own_notes(const CrossoverInput& input, const CrossoverReport& report,
                                   const TemperatureField& field, const Scene& scene,
                                   bool from_file) {
    constexpr std::size_t few = 16;
    std::vector<std::string> notes;
    for (const auto& [region, pixels] : {std::pair{&input.first, report.first_pixels},
                                         std::pair{&input.second, report.second_pixels}}) {
        if (pixels >= few) continue;
        notes.push_back(fmt::format("{}: \"{}\" fills only {}", input.name, region->name,
                                    number_of(pixels, "pixel")));
    }
    const double usual = seconds_between(field.instant.front(), field.instant.back()) /
                         std::max(1.0, double(field.instant.size()) - 1.0);
    if (from_file && usual > 1.5 * scene.time.step) {
        notes.push_back(
            fmt::format("{}: temperatures are stored every {:.0f} s and interpolated linearly; "
                        "without --temperatures the step is {:g} s",
                        input.name, usual, scene.time.step));
    }
    return notes;
}

}  // namespace

StudyFindings crossover_study(const StudyRequest& request) {
    Scene read = request.read();
    check_asked(request, read, "crossover", names_of(read.crossovers), "_curves");
    read.time.every_step = true;
    Study study(std::move(read), request.progress);
    const Scene& scene = study.scene();
    check_asked(request, scene, "crossover", names_of(scene.crossovers), "_curves");
    const SceneWith scene_with = request.scene_with();
    study.count_solves(solves_of(study_solves(scene), "crossover"));
    check_crossovers(study.stages().scene(), scene_with);
    // A shift is the difference to another solution: both then have all facets solved.
    const bool shifts =
        std::any_of(scene.crossovers.begin(), scene.crossovers.end(),
                    [](const auto& input) { return input.refined || !input.uncertain.empty(); });
    const SeenShare seen = [&] { return picture_shares(study.stages()); };
    const TemperatureField field =
        shifts ? study.whole_heat(request.temperatures) : study.heat(request.temperatures, seen);
    const CrossoverAnswer answer = crossovers_of(study, field, scene_with);
    study.progress().finish();
    const double offset = scene.time.utc_offset;
    StudyFindings found{.notes = joined(study.notes(), answer.notes),
                        .not_converged = study.not_converged()};
    for (std::size_t i = 0; i < scene.crossovers.size(); ++i) {
        const CrossoverInput& input = scene.crossovers[i];
        const CrossoverReport& report = answer.report[i];
        const std::vector<std::string> own =
            own_notes(input, report, field, scene, !request.temperatures.empty());
        found.finding.push_back(
            {.name = input.name,
             .texts = {.csv = crossover_csv(input, report, offset),
                       .json = crossover_json(input, scene.observers[input.observer].name, report,
                                              joined(found.notes, own), offset),
                       .svg = crossover_svg(input, report, offset),
                       .more = {{"_curves.csv", contrast_curves_csv(report, offset)}}},
             .reported = reported(input, report, offset),
             .notes = own});
    }
    finish_findings(request, found);
    return found;
}

}  // namespace diurna
