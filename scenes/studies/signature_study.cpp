#include "scenes/studies/signature_study.hpp"

#include <fmt/format.h>
#include <utility>

#include "materials/base/number_of.hpp"
#include "scenes/studies/signature_files.hpp"

namespace diurna {

namespace {

std::vector<std::string> own_notes(const SignatureInput& input, const SignatureReport& report) {
    std::vector<std::string> own{
        fmt::format("{} of {} directions are below the horizontal, where the ground is",
                    report.below, input.directions)};
    if (input.range == 0.0) {
        own.emplace_back(
            "rays begin just outside the object's bounding sphere: the path through the air is "
            "only a few metres");
    }
    if (report.hidden > 0) {
        own.push_back(
            fmt::format("the object is not visible in {}", number_of(report.hidden, "row")));
    }
    if (report.alone > 0) {
        own.push_back(fmt::format("no background is visible in {}, so the contrast is empty there",
                                  number_of(report.alone, "row")));
    }
    return own;
}

}  // namespace

StudyFindings signature_study(const StudyRequest& request) {
    Scene read = request.read();
    check_asked(request, read, "signature", names_of(read.signatures));
    Study study(std::move(read), request.progress);
    const Scene& scene = study.scene();
    check_asked(request, scene, "signature", names_of(scene.signatures));
    const TemperatureField field =
        study.heat(request.temperatures, studied_of(scene.signatures), [&] {
            return view_shares(study.stages(), signature_views(study.stages(), scene.signatures));
        });
    const double offset = scene.time.utc_offset;
    StudyFindings found{.notes = study.notes(), .not_converged = study.not_converged()};
    for (const SignatureInput& input : scene.signatures) {
        const SignatureReport report = signature_of(study.stages(), input, field, study.progress());
        const std::vector<std::string> own = own_notes(input, report);
        found.finding.push_back(
            {.name = input.name,
             .texts = {.csv = signature_csv(report, offset),
                       .json = signature_json(input, report, joined(found.notes, own), offset),
                       .svg = signature_svg(input, report, offset)},
             .reported = fmt::format("{}: {} rows\n", input.name, report.rows.size()),
             .notes = own});
    }
    study.progress().finish();
    finish_findings(request, found);
    return found;
}

}  // namespace diurna
