#include "scenes/commands/scene_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "scenes/commands/told_lines.hpp"
#include "scenes/doubts/doubts.hpp"
#include "scenes/plan/chosen_pictures.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/plan/memory_limit.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/found_heat.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/picture_shares.hpp"
#include "scenes/run/run_folder.hpp"

namespace diurna {

namespace {

void tell_taken(const Stages& stages) {
    if (std::string told = taken_told(stages.store()); !told.empty())
        print_notes({std::move(told)});
}

/// Of verbs that know no variants.
void tell_of_sweep(const Scene& scene) {
    if (scene.sweep.axes.empty()) return;
    fmt::print(stderr, "note: the scene as it stands; its [sweep] is for run\n");
}

void solve_verb(const SceneArguments& a, const std::filesystem::path& out) {
    check_output_file(out);
    const double most = a.memory();
    const Prepared prepared = prepare(a.read());
    check_output_file(out, prepared.scene.files);
    check_memory(prepared.plan, most);
    tell_of_sweep(prepared.scene);
    print_warnings(as_lines(doubts(prepared)));
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared, a.stages());
    stages.at(0);
    const auto inputs =
        stages.store() == nullptr ? std::vector<RunInput>{} : run_inputs(prepared.scene);
    const SceneHeat heat = scene_heat(stages, inputs, progress, 0.0);
    progress.finish();
    write_heat(prepared, heat.result, out);
    print_notes(prepared.notes);
    print_notes(told_as("note", heat));
    tell_taken(stages);
    for (const std::string& start : told_as("start", heat)) print_notes({"start: " + start});
    if (const std::string told = told_as("not converged", heat).front(); !told.empty())
        throw std::runtime_error(told);  // what there is is kept
}

/// Throws InputError for pictures of facets that another run left to others of their kind.
void check_solved(const Stages& stages, const TemperatureField& field,
                  const std::filesystem::path& temperatures) {
    if (field.solved_as.empty()) return;
    const std::vector<float> share = picture_shares(stages);
    float most = 0.0f;
    for (std::size_t f = 0; f < share.size(); ++f) {
        if (field.solved_as[f] != f) most = std::max(most, share[f]);
    }
    if (most == 0.0f) return;
    throw InputError(temperatures.string(),
                     fmt::format("was solved for other pictures (tolerance_K): of these a facet "
                                 "that fills {:.2g} % of one was left to others of its kind",
                                 100.0f * most),
                     "run the scene with these observers, or solve it without tolerance_K");
}

void render_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                 const std::filesystem::path& out, const std::vector<std::string>& only) {
    check_run_folder(out, FolderKind::run);
    const double most = a.memory();
    const Prepared prepared = prepare(a.read());
    check_memory(prepared.plan, most);
    tell_of_sweep(prepared.scene);
    const std::vector<RunInput> inputs = run_inputs(prepared.scene);
    check_no_input_in(out, inputs);
    check_no_input_in(out, {{temperatures, "", ""}});
    const TemperatureField field = load_temperature_field(temperatures);
    if (field.facets != prepared.world.surfaces().size()) {
        throw InputError(temperatures.string(),
                         fmt::format("found temperatures of {} facets, expected {} as in the scene",
                                     field.facets, prepared.world.surfaces().size()));
    }
    const std::vector<ObserverInput> chosen = chosen_pictures(prepared.scene, {.only = only});
    std::vector<Instant> frames;
    for (const ObserverInput& observer : chosen)
        frames.insert(frames.end(), observer.frames.begin(), observer.frames.end());
    check_covers(field, frames, temperatures);
    const FolderLock lock(out);
    const std::size_t gone =
        clear_run_folder(out, {}, frame_files(chosen, prepared.scene.labels.format));
    if (gone > 0) fmt::print(stderr, "note: {} files of earlier runs removed\n", gone);
    std::filesystem::create_directories(out / "frames");
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared, a.stages());
    stages.at(0);
    tell_taken(stages);
    check_solved(stages, field, temperatures);
    const FramesReport report = render_frames(stages, chosen, field, out, progress);
    for (const auto& notes : {report.notes, report.warnings}) print_notes(notes);
}

}  // namespace

void add_solve_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("solve", "temperatures alone");
    const auto a = solving_arguments(*verb);
    const auto out = std::make_shared<std::filesystem::path>();
    verb->add_option("--out", *out, "netCDF file")->required();
    verb->callback([a, out] { solve_verb(*a, *out); });
}

void add_render_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("render", "frames from given temperatures");
    const auto a = solving_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("out");
    verb->add_option("--temperatures", *temperatures, "netCDF file of `solve`")->required();
    verb->add_option("--out", *out, "folder for the results (default: out)");
    const auto only = std::make_shared<std::vector<std::string>>();
    verb->add_option("--only", *only, only_told);
    verb->callback([=] { render_verb(*a, *temperatures, *out, *only); });
}

}  // namespace diurna
