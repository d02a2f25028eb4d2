#include "scenes/commands/crossover_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/studies/crossover_files.hpp"
#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

void print_crossing(const CrossoverInput& input, const TimedCrossing& one, double utc_offset) {
    const std::string& warmer = one.first_warmer_after ? input.first.name : input.second.name;
    fmt::print("  {}  ", format_local(one.when, utc_offset));
    if (one.kind == ZeroCrossing::Kind::touches) {
        fmt::print("touches: {} stays warmer, {:.2g} K at the least", warmer, std::abs(one.least));
    } else if (one.kind == ZeroCrossing::Kind::jumps) {
        fmt::print("{} is warmer after, at once", warmer);
    } else {
        fmt::print("{} is warmer after, {:+.2f} K/h", warmer, 3600.0 * one.slope);
    }
    if (one.kind != ZeroCrossing::Kind::touches && !input.uncertain.empty()) {
        fmt::print(", +- {:.1f} min", one.sigma / 60.0);
    }
    if (one.refined) fmt::print(", refined by {:+.0f} s", *one.refined);
    for (const std::string& key : gone_with(input, one)) fmt::print(", gone with {}", key);
    fmt::print("\n");
}

void print_report(const CrossoverInput& input, const CrossoverReport& report, double utc_offset) {
    for (const CrossoverDay& day : report.band) {
        const double hours = seconds_between(day.instant.front(), day.instant.back()) / 3600.0;
        fmt::print("{} {} um: {} and {}, {} and {} pixels: {:.1f} of {:.1f} h below {:g} K\n",
                   input.name, day.band, input.first.name, input.second.name, report.first_pixels,
                   report.second_pixels, day.lost / 3600.0, hours, input.threshold);
        if (day.crossing.empty()) {
            fmt::print("  no crossover: {:.2f} K apart at the least\n", day.worst_least);
        }
        for (const TimedCrossing& one : day.crossing) print_crossing(input, one, utc_offset);
    }
}

/// Notes of one crossover that its figures alone would not tell.
std::vector<std::string> own_notes(const CrossoverInput& input, const CrossoverReport& report,
                                   const TemperatureField& field, const Scene& scene,
                                   bool from_file) {
    constexpr std::size_t few = 16;
    std::vector<std::string> notes;
    for (const auto& [region, pixels] : {std::pair{&input.first, report.first_pixels},
                                         std::pair{&input.second, report.second_pixels}}) {
        if (pixels >= few) continue;
        notes.push_back(
            fmt::format("{}: \"{}\" fills {} pixels only", input.name, region->name, pixels));
    }
    const double usual = seconds_between(field.instant.front(), field.instant.back()) /
                         std::max(1.0, double(field.instant.size()) - 1.0);
    if (from_file && usual > 1.5 * scene.time.step) {
        notes.push_back(
            fmt::format("{}: temperatures are kept every {:.0f} s and straight between "
                        "them; without --temperatures every {:g} s",
                        input.name, usual, scene.time.step));
    }
    return notes;
}

void crossover_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                    const std::filesystem::path& out) {
    Scene read = a.read();
    read.time.every_step = true;
    Study study(std::move(read), a.style());
    const Scene& scene = study.scene();
    if (scene.crossovers.empty()) {
        throw InputError(scene.file.string(), "no table [[crossover]], expected one at least");
    }
    std::vector<std::string> names;
    for (const CrossoverInput& input : scene.crossovers) names.push_back(input.name);
    check_study_files(out, names, scene.files);
    const SceneWith scene_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> settings = a.settings;
        settings.insert(settings.end(), more.begin(), more.end());
        return read_scene(a.scene, settings, a.allow_outside);
    };
    check_crossovers(study, scene_with);
    const TemperatureField field = study.heat(temperatures);
    const CrossoverAnswer answer = crossovers_of(study, field, scene_with);
    study.progress().finish();
    const double offset = scene.time.utc_offset;
    std::vector<std::string> notes = study.notes();
    notes.insert(notes.end(), answer.notes.begin(), answer.notes.end());
    for (std::size_t i = 0; i < scene.crossovers.size(); ++i) {
        const CrossoverInput& input = scene.crossovers[i];
        const CrossoverReport& report = answer.report[i];
        std::vector<std::string> own = notes;
        for (std::string& note : own_notes(input, report, field, scene, !temperatures.empty())) {
            own.push_back(std::move(note));
        }
        write_study_files(out, input.name,
                          {.csv = crossover_csv(input, report, offset),
                           .json = crossover_json(input, scene.observers[input.observer].name,
                                                  report, own, offset),
                           .svg = crossover_svg(input, report, offset)});
        write_whole_file(out / (input.name + "_curves.csv"), contrast_curves_csv(report, offset));
        print_report(input, report, offset);
        fmt::print("{}.csv, .json, .svg, _curves.csv\n", (out / input.name).string());
        for (std::size_t n = i == 0 ? 0 : notes.size(); n < own.size(); ++n) {
            fmt::print(stderr, "note: {}\n", plain(own[n]));
        }
    }
    if (!study.not_converged().empty()) throw std::runtime_error(study.not_converged());
}

}  // namespace

void add_crossover_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "crossover", "when two things look equally warm to an observer: [[crossover]]");
    const auto a = scene_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("crossover");
    verb->add_option("--temperatures", *temperatures,
                     "netCDF file of `solve`; else they are solved, and kept at every step");
    verb->add_option("--out", *out, "folder for the results (default: crossover)");
    verb->callback([a, temperatures, out] { crossover_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
