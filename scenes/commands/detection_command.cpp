#include "scenes/commands/detection_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/studies/detection_files.hpp"
#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// A line for each instant, way and task: the ranges of the probabilities asked of.
void print_ranges(const DetectionInput& input, const std::vector<DetectionCurve>& curves,
                  double utc_offset) {
    for (const DetectionCurve& curve : curves) {
        fmt::print("{} {}: {:.2f} K at the eye {:.0f} m away, {:.1f} m2\n", input.name,
                   format_local(curve.target.when, utc_offset), curve.target.contrast,
                   curve.target.range, curve.target.area);
        for (std::size_t t = 0; t < 3; ++t) {
            std::string line = fmt::format("  {:<15}", tasks[t].name);
            for (std::size_t p = 0; p < input.probabilities.size(); ++p) {
                line += fmt::format("  P {:g}: {:.2f} km (TTP), {:.2f} km (Johnson)",
                                    input.probabilities[p], curve.metric_range[t][p] / 1000.0,
                                    curve.johnson_range[t][p] / 1000.0);
            }
            fmt::print("{}\n", line);
        }
    }
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

void detection_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                    const std::filesystem::path& out) {
    Study study(a.read(), a.style());
    const Scene& scene = study.scene();
    if (scene.detections.empty()) {
        throw InputError(scene.file.string(), "no table [[detection]], expected one at least");
    }
    std::vector<StudiedObject> studied;
    std::vector<std::string> names;
    for (const DetectionInput& input : scene.detections) {
        studied.push_back(input.studied);
        names.push_back(input.name);
    }
    check_study_files(out, names, scene.files);
    const TemperatureField field = study.heat(temperatures, studied);
    const double offset = scene.time.utc_offset;
    std::vector<std::vector<DetectionCurve>> all;
    for (const DetectionInput& input : scene.detections) {
        all.push_back(detection_of(study.stages(), input, field, study.progress()));
    }
    study.progress().finish();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const DetectionInput& input = scene.detections[i];
        std::vector<std::string> own = study.notes();
        for (std::string& note : detection_notes(scene, input)) own.push_back(std::move(note));
        if (const std::size_t cut = cut_off(input, all[i]); cut > 0) {
            own.push_back(fmt::format("{} ranges end at range_m's ends, {:g} (told as 0) or {:g} m",
                                      cut, input.range[0], input.range[1]));
        }
        const std::string instrument = scene.instruments[input.instrument].instrument.name;
        const std::filesystem::path base = out / input.name;
        write_study_files(out, input.name,
                          {.csv = detection_csv(all[i], offset),
                           .json = detection_json(input, instrument, all[i], own, offset),
                           .svg = detection_svg(input, all[i], offset)});
        print_ranges(input, all[i], offset);
        fmt::print("{}.csv, .json, .svg\n", base.string());
        print_notes(own);
    }
    if (!study.not_converged().empty()) throw std::runtime_error(study.not_converged());
}

}  // namespace

void add_detection_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "detection", "ranges at which an instrument's display shows objects: [[detection]]");
    const auto a = scene_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("detection");
    verb->add_option("--temperatures", *temperatures,
                     "netCDF file of `solve`; else they are solved");
    verb->add_option("--out", *out, "folder for the results (default: detection)");
    verb->callback([a, temperatures, out] { detection_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
