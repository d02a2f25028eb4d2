#include "scenes/studies/detection_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scenes/studies/detection_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// A line for each instant, way and task: the ranges of the probabilities asked of.
std::string reported(const DetectionInput& input, const std::vector<DetectionCurve>& curves,
                     double utc_offset) {
    std::string text;
    for (const DetectionCurve& curve : curves) {
        text += fmt::format("{} {}: {:.2f} K at the instrument, {:.0f} m away, {:.1f} m2\n",
                            input.name, format_local(curve.target.when, utc_offset),
                            curve.target.contrast, curve.target.range, curve.target.area);
        for (std::size_t t = 0; t < 3; ++t) {
            std::string line = fmt::format("  {:<15}", tasks[t].name);
            for (std::size_t p = 0; p < input.probabilities.size(); ++p) {
                line += fmt::format("  P {:g}: {:.2f} km (TTP), {:.2f} km (Johnson)",
                                    input.probabilities[p], curve.metric_range[t][p] / 1000.0,
                                    curve.johnson_range[t][p] / 1000.0);
            }
            text += line + "\n";
        }
    }
    return text;
}

/// Ranges that end where what was asked of does.
std::size_t cut_off(const DetectionInput& input, const std::vector<DetectionCurve>& curves) {
    std::size_t count = 0;
    for (const DetectionCurve& curve : curves) {
        for (const auto* ranges : {&curve.johnson_range, &curve.metric_range}) {
            for (const std::vector<double>& of_task : *ranges) {
                for (const double range : of_task) {
                    count += range == 0.0 || range == input.range[1] ? 1 : 0;
                }
            }
        }
    }
    return count;
}

std::vector<std::string> own_notes(const DetectionInput& input,
                                   const std::vector<DetectionCurve>& curves, const Scene& scene) {
    std::vector<std::string> own = detection_notes(scene, input);
    if (const std::size_t cut = cut_off(input, curves); cut > 0) {
        own.push_back(
            fmt::format("{} ranges are at the limits of range_m, {:g} m (written as 0) or {:g} m",
                        cut, input.range[0], input.range[1]));
    }
    return own;
}

}  // namespace

StudyFindings detection_study(const StudyRequest& request) {
    Scene read = request.read();
    check_asked(request, read, "detection", names_of(read.detections));
    Study study(std::move(read), request.progress);
    const Scene& scene = study.scene();
    check_asked(request, scene, "detection", names_of(scene.detections));
    const TemperatureField field =
        study.heat(request.temperatures, studied_of(scene.detections), [&] {
            return view_shares(study.stages(), detection_views(study.stages(), scene.detections));
        });
    const double offset = scene.time.utc_offset;
    StudyFindings found{.notes = study.notes(), .not_converged = study.not_converged()};
    for (const DetectionInput& input : scene.detections) {
        const std::vector<DetectionCurve> curves =
            detection_of(study.stages(), input, field, study.progress());
        const std::vector<std::string> own = own_notes(input, curves, scene);
        const std::string& instrument = scene.instruments[input.instrument].instrument.name;
        found.finding.push_back({.name = input.name,
                                 .texts = {.csv = detection_csv(curves, offset),
                                           .json = detection_json(input, instrument, curves,
                                                                  joined(found.notes, own), offset),
                                           .svg = detection_svg(input, curves, offset)},
                                 .reported = reported(input, curves, offset),
                                 .notes = own});
    }
    study.progress().finish();
    finish_findings(request, found);
    return found;
}

}  // namespace diurna
