#include "scenes/commands/contrast_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/studies/contrast_files.hpp"
#include "scenes/studies/signature_scene.hpp"
#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// A line for each target and band: when and from where it stands out most.
void print_worst(const ContrastInput& input, const ContrastReport& report, const Scene& scene) {
    for (std::size_t w = 0; w < report.worst.size(); ++w) {
        const WorstContrast& worst = report.worst[w];
        const std::string& target = input.targets[w / input.bands.size()].name;
        const std::string& band = input.bands[w % input.bands.size()];
        if (worst.row >= report.row.size()) {
            fmt::print("{}: {} in {} um: never seen\n", input.name, target, band);
            continue;
        }
        const ContrastRow& row = report.row[worst.row];
        fmt::print(
            "{}: {} in {} um: {:.2f} +- {:.2g} K at {} from {}; above {:g} K in {:.0f} % of "
            "its pictures, {:.2f} K at best; clutter {:.2f} K\n",
            input.name, target, band, row.rss, worst.error,
            format_local(row.when, scene.time.utc_offset),
            scene.observers[input.observers[row.observer]].name, input.threshold,
            100.0 * worst.share, worst.least, row.clutter);
    }
}

std::vector<std::string> own_notes(const ContrastInput& input, const ContrastReport& report) {
    std::vector<std::string> notes;
    if (report.hidden > 0) {
        notes.push_back(
            fmt::format("{}: nothing of a target, or no background, is seen in {} of "
                        "{} rows",
                        input.name, report.hidden, report.row.size()));
    }
    std::size_t small = 0;
    for (const ContrastRow& row : report.row) small += row.pixels > 0.0 && row.pixels < 16.0;
    if (small > 0) {
        notes.push_back(
            fmt::format("{}: the target covers less than 16 pixels in {} rows: spread, "
                        "entropy and similarity are of few",
                        input.name, small));
    }
    return notes;
}

void contrast_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                   const std::filesystem::path& out) {
    Study study(a.read(), a.style());
    const Scene& scene = study.scene();
    if (scene.contrasts.empty()) {
        throw InputError(scene.file.string(), "no table [[contrast]], expected one at least");
    }
    std::vector<std::string> names;
    for (const ContrastInput& input : scene.contrasts) names.push_back(input.name);
    check_study_files(out, names, scene.files);
    const TemperatureField field = study.heat(temperatures);
    std::vector<ContrastReport> reports;
    for (const ContrastInput& input : scene.contrasts) {
        reports.push_back(contrast_of(study.stages(), input, field, study.progress()));
    }
    study.progress().finish();
    print_notes(study.notes());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const ContrastInput& input = scene.contrasts[i];
        const std::vector<std::string> own = own_notes(input, reports[i]);
        std::vector<std::string> notes = study.notes();
        notes.insert(notes.end(), own.begin(), own.end());
        write_study_files(out, input.name,
                          {.csv = contrast_csv(input, reports[i], scene),
                           .json = contrast_json(input, reports[i], scene, notes),
                           .svg = contrast_svg(input, reports[i], scene)});
        print_worst(input, reports[i], scene);
        fmt::print("{}.csv, .json, .svg\n", (out / input.name).string());
        print_notes(own);
    }
    if (!study.not_converged().empty()) throw std::runtime_error(study.not_converged());
}

}  // namespace

void add_contrast_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "contrast", "how targets stand out from what is around them: [[contrast]]");
    const auto a = scene_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("contrast");
    verb->add_option("--temperatures", *temperatures,
                     "netCDF file of `solve`; else they are solved");
    verb->add_option("--out", *out, "folder for the results (default: contrast)");
    verb->callback([a, temperatures, out] { contrast_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
