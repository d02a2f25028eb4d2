#include "scenes/studies/contrast_study.hpp"

#include <fmt/format.h>

#include "materials/base/number_of.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/studies/band_words.hpp"
#include "scenes/studies/contrast_files.hpp"
#include "scenes/studies/signature_scene.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// A line for each target and band: when and from where it stands out most.
std::string reported(const ContrastInput& input, const ContrastReport& report, const Scene& scene) {
    std::string text;
    for (std::size_t w = 0; w < report.worst.size(); ++w) {
        const WorstContrast& worst = report.worst[w];
        const std::string& target = input.targets[w / input.bands.size()].name;
        const std::string band = band_words(input.bands[w % input.bands.size()]);
        if (worst.row >= report.row.size()) {
            text +=
                fmt::format("{}: {} in {}: not visible in any picture\n", input.name, target, band);
            continue;
        }
        const ContrastRow& row = report.row[worst.row];
        text += fmt::format(
            "{}: {} in {}: highest {:.2f} +- {:.2g} K at {} from {}, clutter {:.2f} K; lowest "
            "{:.2f} K; above {:g} K in {:.0f} % of the pictures\n",
            input.name, target, band, row.rss, worst.error,
            format_local(row.when, scene.time.utc_offset),
            scene.observers[input.observers[row.observer]].name, row.clutter, worst.least,
            input.threshold, 100.0 * worst.share);
    }
    return text;
}

std::vector<std::string> own_notes(const ContrastInput& input, const ContrastReport& report) {
    std::vector<std::string> notes;
    if (report.hidden > 0) {
        notes.push_back(fmt::format("{}: target or background not visible in {} of {} rows",
                                    input.name, report.hidden, report.row.size()));
    }
    std::size_t small = 0;
    for (const ContrastRow& row : report.row) small += row.pixels > 0.0 && row.pixels < 16.0;
    if (small > 0) {
        notes.push_back(
            fmt::format("{}: the target covers less than 16 pixels in {}: the spread, entropy and "
                        "similarity are inaccurate",
                        input.name, number_of(small, "row")));
    }
    return notes;
}

}  // namespace

StudyFindings contrast_study(const StudyRequest& request) {
    Study study(request.read(), request.progress);
    const Scene& scene = study.scene();
    check_asked(request, scene, "contrast", names_of(scene.contrasts));
    const TemperatureField field =
        study.heat(request.temperatures, [&] { return picture_shares(study.stages()); });
    StudyFindings found{.notes = study.notes(), .not_converged = study.not_converged()};
    for (const ContrastInput& input : scene.contrasts) {
        const ContrastReport report = contrast_of(study.stages(), input, field, study.progress());
        const std::vector<std::string> own = own_notes(input, report);
        found.finding.push_back(
            {.name = input.name,
             .texts = {.csv = contrast_csv(input, report, scene),
                       .json = contrast_json(input, report, scene, joined(found.notes, own)),
                       .svg = contrast_svg(input, report, scene)},
             .reported = reported(input, report, scene),
             .notes = own});
    }
    study.progress().finish();
    write_findings(request, found);
    return found;
}

}  // namespace diurna
