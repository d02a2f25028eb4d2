#include "scenes/studies/contrast_study.hpp"

#include <fmt/format.h>
#include <utility>

#include "materials/base/number_of.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/studies/band_words.hpp"
#include "scenes/studies/contrast_files.hpp"
#include "scenes/studies/signature_scene.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// "clutter 0.31 K", or why there is none.
std::string clutter_words(const ContrastRow& row, const ObserverInput& observer) {
    const std::string why = why_no_clutter(row, observer);
    return why.empty() ? fmt::format("clutter {:.2f} K", row.clutter)
                       : fmt::format("clutter not defined ({})", why);
}

/// A line for each target, band and observer: when the target stands out most, and when least.
std::string reported(const ContrastInput& input, const ContrastReport& report, const Scene& scene) {
    std::string text;
    for (const ContrastSummary& one : report.summary) {
        const ObserverInput& observer = scene.observers[input.observers[one.observer]];
        text += fmt::format("{}: {} in {} from {}: ", input.name, input.targets[one.target].name,
                            band_words(input.bands[one.band]), observer.name);
        if (one.highest >= report.row.size()) {
            text += "not visible in any picture\n";
            continue;
        }
        const ContrastRow& highest = report.row[one.highest];
        const ContrastRow& lowest = report.row[one.lowest];
        text += fmt::format(
            "highest {:.2f} K (sampling {:.2g} K) at {}, {}; lowest {:.2f} K at {}; above {:g} K "
            "in {:.0f} % of the pictures\n",
            highest.rss, one.sampling_change, format_local(highest.when, scene.time.utc_offset),
            clutter_words(highest, observer), lowest.rss,
            format_local(lowest.when, scene.time.utc_offset), input.threshold, 100.0 * one.share);
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
    Scene read = request.read();
    check_asked(request, read, "contrast", names_of(read.contrasts));
    Study study(std::move(read), request.progress);
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
    finish_findings(request, found);
    return found;
}

}  // namespace diurna
