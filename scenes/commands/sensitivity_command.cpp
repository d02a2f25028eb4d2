#include "scenes/commands/sensitivity_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/studies/sensitivity_files.hpp"
#include "scenes/studies/study_files.hpp"

namespace diurna {

namespace {

std::string shown(double value) {
    return std::isfinite(value) ? fmt::format("{:+.3f}", value) : "gone";
}

void print_report(const SensitivityInput& input, const SensitivityReport& report) {
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const OutputSensitivity& one = report.output[o];
        if (!std::isfinite(one.base)) {
            fmt::print("{}: no such crossover\n", plain(input.outputs[o].name));
            continue;
        }
        const char* unit = unit_of(input.outputs[o]);
        fmt::print("{}: {:.3f} {}", plain(input.outputs[o].name), one.base, unit);
        if (std::isfinite(one.deviation)) fmt::print(" +- {:.3f}", one.deviation);
        fmt::print("\n");
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            fmt::print("  {}: {} at {:g}, {} at {:g}", plain(input.uncertain[u].key),
                       shown(one.alone[u].low - one.base), input.uncertain[u].low,
                       shown(one.alone[u].high - one.base), input.uncertain[u].high);
            if (!one.effect.empty() && one.effect[u].count > 0) {
                fmt::print("; mu* {:.3f}", one.effect[u].mean_size);
                if (one.effect[u].count > 1) {
                    fmt::print(" +- {:.3f}, sigma {:.3f}", one.effect[u].size_error,
                               one.effect[u].deviation);
                }
            }
            fmt::print("\n");
        }
    }
}

void sensitivity_verb(const SceneArguments& a, const std::filesystem::path& out) {
    Scene read = a.read();
    read.time.every_step = true;
    Study study(std::move(read), a.style());
    const Scene& scene = study.scene();
    if (scene.sensitivities.empty()) {
        throw InputError(scene.file.string(), "no table [[sensitivity]], expected one at least");
    }
    std::vector<std::string> names;
    for (const SensitivityInput& input : scene.sensitivities) names.push_back(input.name);
    check_study_files(out, names, scene.files);
    const SceneWith scene_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> settings = a.settings;
        settings.insert(settings.end(), more.begin(), more.end());
        return read_scene(a.scene, settings, a.allow_outside);
    };
    for (const SensitivityInput& input : scene.sensitivities) {
        check_sensitivity(study, input, scene_with);
    }
    const TemperatureField field = study.heat("");
    std::vector<SensitivityReport> reports;
    for (const SensitivityInput& input : scene.sensitivities) {
        reports.push_back(sensitivity_of(study, input, field, scene_with));
    }
    study.progress().finish();
    bool converged = true;
    print_notes(study.notes());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const SensitivityInput& input = scene.sensitivities[i];
        std::vector<std::string> notes = study.notes();
        notes.insert(notes.end(), reports[i].notes.begin(), reports[i].notes.end());
        write_study_files(out, input.name,
                          {.csv = sensitivity_csv(input, reports[i]),
                           .json = sensitivity_json(input, reports[i], notes),
                           .svg = sensitivity_svg(input, reports[i])});
        print_report(input, reports[i]);
        fmt::print("{}.csv, .json, .svg\n", (out / input.name).string());
        print_notes(reports[i].notes);
        converged &= reports[i].converged;
    }
    if (!study.not_converged().empty()) throw std::runtime_error(study.not_converged());
    if (!converged)
        throw std::runtime_error("the heat balance of a changed scene has not converged");
}

}  // namespace

void add_sensitivity_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "sensitivity", "what numbers that are not known well do to figures: [[sensitivity]]");
    const auto a = scene_arguments(*verb);
    const auto out = std::make_shared<std::filesystem::path>("sensitivity");
    verb->add_option("--out", *out, "folder for the results (default: sensitivity)");
    verb->callback([a, out] { sensitivity_verb(*a, *out); });
}

}  // namespace diurna
