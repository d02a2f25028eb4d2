#include "scenes/job/run/audit.hpp"

#include <fmt/format.h>

#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "scenes/job/store/inputs.hpp"

namespace diurna {

namespace fs = std::filesystem;

AuditedRun audited_run(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw InputError(folder.string(), "no such folder");
    const ListedOutputs listed = listed_outputs(folder);
    if (!listed.found || !listed.done || listed.scene.empty()) {
        throw InputError(folder.string(), "is not the folder of a complete run",
                         "diurna run SCENE --out FOLDER writes one");
    }
    if (!listed.digest.contains("temperatures.nc")) {
        throw InputError(folder.string(), "was rendered from temperatures of another file",
                         "audit the run that computed them");
    }
    for (const std::string& setting : listed.settings) {
        if (setting.find('=') != std::string::npos) continue;
        throw InputError(folder.string(),
                         fmt::format("is of {} of a sweep, which cannot be audited", setting),
                         "audit a run of the scene with the variant's settings (--set)");
    }
    return {.scene = listed.scene, .settings = listed.settings, .key = listed.key};
}

Audit audit(const AuditedRun& run, Scene scene, int checks, const ProgressTo& to) {
    Progress progress(to);
    progress.stage(StageId::terrain);
    const Prepared prepared = prepare(std::move(scene));
    if (!can_check(prepared)) {
        throw InputError(prepared.scene.file.string(),
                         "places cannot be solved separately: a state is written or read");
    }
    check_start(prepared);
    const std::string key = job_key(run_inputs(prepared.scene), run.settings);
    progress.stage(StageId::sky_view);
    const Stages stages(prepared);
    stages.at(0);
    HeatDecision decision = prepared.plan.decisions.heat;
    decision.check_points = checks;
    const SolvedScene solved = solve_scene(stages, progress, decision);
    progress.finish();
    return {.error = solved.check,
            .places = solved.places,
            .unchecked = solved.unchecked,
            .pictures = prepared.plan.views,
            .tolerance = prepared.scene.tolerance,
            .not_converged = not_converged(solved.report),
            .same_inputs = key == run.key};
}

std::vector<std::string> audit_lines(const Audit& audit) {
    const CheckError& error = audit.error;
    const std::string not_checked =
        audit.unchecked == 0
            ? ""
            : fmt::format(
                  "not checked: {} on panes, nets, sheets, targets, copies or moving objects",
                  number_of(audit.unchecked, "drawn place"));
    if (audit.places == 0) {
        return {"no picture beyond 3 µm shows ground or a plain object: nothing was checked",
                not_checked};
    }
    std::vector<std::string> lines{
        fmt::format("{} in {} solved separately, each with sun, sky and surroundings of its own",
                    number_of(audit.places, "place"), number_of(audit.pictures, "view")),
        fmt::format("{:<24} {:8.3f} K   95 % interval {:.3f} to {:.3f} K", "rms difference",
                    error.rms, error.low, error.high),
        fmt::format("{:<24} {:8.3f} K   facets against themselves with more rays",
                    "by the number of rays", error.by_rays),
        fmt::format("{:<24} {:8.3f} K", "99th percentile", error.percentile_99),
        fmt::format("{:<24} {:8.3f} K   {}", "largest", error.worst, error.worst_at)};
    for (const CheckError::Of& of : error.observer) {
        lines.push_back(fmt::format("{:<24} {:8.3f} K   rms of {}", "observer " + of.name, of.rms,
                                    number_of(of.points, "place")));
    }
    for (const CheckError::Of& of : error.share) {
        lines.push_back(fmt::format("{:<24} {:8.1f} %   of the mean square, {}",
                                    "material " + of.name, 100.0 * of.rms,
                                    number_of(of.points, "place")));
    }
    if (!error.set.empty() && error.low > audit.tolerance) {
        lines.push_back(fmt::format("{:<24} {}", fmt::format("for {:g} K, set", audit.tolerance),
                                    in_words(error.set)));
    }
    if (!not_checked.empty()) lines.push_back(not_checked);
    return lines;
}

}  // namespace diurna
