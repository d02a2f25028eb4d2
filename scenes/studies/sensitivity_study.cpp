#include "scenes/studies/sensitivity_study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "materials/base/plain_text.hpp"
#include "scenes/studies/sensitivity_files.hpp"
#include "scenes/studies/study_solves.hpp"

namespace diurna {

namespace {

std::string shown(double value) {
    return std::isfinite(value) ? fmt::format("{:+.3f}", value) : "absent";
}

std::string reported(const SensitivityInput& input, const SensitivityReport& report) {
    std::string text;
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const OutputSensitivity& one = report.output[o];
        if (!std::isfinite(one.base)) {
            text += fmt::format("{}: no such crossover\n", plain(input.outputs[o].name));
            continue;
        }
        const char* unit = unit_of(input.outputs[o]);
        text += fmt::format("{}: {:.3f} {}", plain(input.outputs[o].name), one.base, unit);
        if (std::isfinite(one.deviation)) {
            text += fmt::format(" +- {:.3g} (one standard deviation of the given ranges)",
                                one.deviation);
        }
        text += "\n";
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            text += fmt::format("  {}: {} at {:g}, {} at {:g}", plain(input.uncertain[u].key),
                                shown(one.alone[u].low - one.base), input.uncertain[u].low,
                                shown(one.alone[u].high - one.base), input.uncertain[u].high);
            if (!one.effect.empty() && one.effect[u].count > 0) {
                text += fmt::format("; mu* {:.3f}", one.effect[u].mean_size);
                if (one.effect[u].count > 1) {
                    text += fmt::format(" +- {:.3f} (standard error), sigma {:.3f}",
                                        one.effect[u].size_error, one.effect[u].deviation);
                }
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace

StudyFindings sensitivity_study(const StudyRequest& request) {
    Scene read = request.read();
    check_asked(request, read, "sensitivity", names_of(read.sensitivities));
    read.time.every_step = true;
    Study study(std::move(read), request.progress);
    const Scene& scene = study.scene();
    check_asked(request, scene, "sensitivity", names_of(scene.sensitivities));
    const SceneWith scene_with = request.scene_with();
    study.count_solves(solves_of(study_solves(scene), "sensitivity"));
    for (const SensitivityInput& input : scene.sensitivities) {
        check_sensitivity(study.stages().scene(), input, scene_with);
    }
    const TemperatureField field = study.whole_heat("");
    StudyFindings found{.notes = study.notes(), .not_converged = study.not_converged()};
    for (const SensitivityInput& input : scene.sensitivities) {
        const SensitivityReport report = sensitivity_of(study, input, field, scene_with);
        found.finding.push_back(
            {.name = input.name,
             .texts = {.csv = sensitivity_csv(input, report),
                       .json = sensitivity_json(input, report, joined(found.notes, report.notes)),
                       .svg = sensitivity_svg(input, report)},
             .reported = reported(input, report),
             .notes = report.notes});
        if (found.not_converged.empty() && !report.converged) {
            found.not_converged = fmt::format(
                "{}: the heat balance of a changed scene has not converged; a shorter time.step_s "
                "or a longer weather record before the start may help",
                input.name);
        }
    }
    study.progress().finish();
    finish_findings(request, found);
    return found;
}

}  // namespace diurna
