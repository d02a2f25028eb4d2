#include "scenes/job/run/given_field.hpp"

#include <utility>

#include "scenes/job/run/found_heat.hpp"
#include "scenes/job/run/given_heat.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/job/run/represented.hpp"

namespace diurna {

namespace fs = std::filesystem;

void report_heat(HeatReport heat, JobReport& report) {
    report.not_converged = std::move(heat.not_converged);
    report.start = std::move(heat.start);
    report.notes.insert(report.notes.end(), heat.notes.begin(), heat.notes.end());
    report.heat.insert(report.heat.end(), heat.rows.begin(), heat.rows.end());
}

TemperatureField given_field(const Stages& stages, const Manifest& manifest,
                             const std::vector<ObserverInput>& chosen, const fs::path& file,
                             Progress& progress, JobReport& report) {
    std::vector<RunInput> inputs = manifest.inputs;
    inputs.pop_back();  // the temperatures themselves
    GivenHeat given = given_heat(stages.scene(), inputs, file);
    std::vector<Instant> frames;
    for (const ObserverInput& observer : chosen)
        frames.insert(frames.end(), observer.frames.begin(), observer.frames.end());
    check_covers(given.field, frames, file);
    report.warnings.insert(report.warnings.end(), given.warnings.begin(), given.warnings.end());
    if (!given.field.solved_as.empty()) {
        progress.stage(StageId::sky_view);
        const double tolerance = stages.scene().scene.tolerance;
        const RepresentedEffect effect =
            represented_effect(stages, given.field, picture_shares(stages));
        report.notes.push_back(in_words(effect, file, tolerance, "facets that the pictures need"));
        if (!effect.within(tolerance)) {
            SceneHeat heat =
                scene_heat(stages, inputs, progress, stages.scene().plan.decisions.heat);
            report.solve = heat.result.report;
            report.solved = heat.solved;
            report_heat(std::move(heat.report), report);
            return std::move(heat.result.temperature);
        }
    }
    report.heat.emplace_back("temperatures", "from file: " + file.filename().string());
    return std::move(given.field);
}

}  // namespace diurna
