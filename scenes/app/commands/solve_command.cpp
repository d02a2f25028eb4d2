#include "scenes/app/commands/solve_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/found_heat.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "scenes/job/store/inputs.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"

namespace diurna {

namespace {

void tell_taken(const Stages& stages) {
    if (std::string reported = taken_reported(stages.store()); !reported.empty())
        print_notes({std::move(reported)});
}

void solve_verb(const SceneArguments& a, const std::filesystem::path& out) {
    check_output_file(out);
    const double most = a.memory();
    Scene scene = a.read();
    check_output_file(out, named_inputs(scene));
    for (const std::string& file : radiometer_files(scene)) {
        check_output_file(out.parent_path() / file, named_inputs(scene));
    }
    const Prepared prepared = prepare(std::move(scene));
    check_output_file(out, prepared.scene.files);
    check_memory(prepared.plan, most);
    tell_of_sweep(prepared.scene);
    print_warnings(as_lines(scene_warnings(prepared)));
    Progress progress(a.style());
    progress.stage(StageId::sky_view);
    const Stages stages(prepared, a.stages());
    stages.at(0);
    const std::vector<RunInput> inputs = run_inputs(prepared.scene);
    SceneHeat heat = scene_heat(stages, inputs, progress, {});
    progress.finish();
    write_heat(prepared, inputs, heat.result, out);
    write_radiometers(stages, heat.result, out.parent_path(), heat.report);
    print_notes(prepared.notes);
    print_notes(heat.report.notes);
    tell_taken(stages);
    print_notes({"start: " + heat.report.start});
    if (!heat.report.not_converged.empty()) {
        throw std::runtime_error(heat.report.not_converged);  // the file is kept
    }
}

}  // namespace

void add_solve_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("solve", "temperatures only, without pictures");
    const auto a = solving_arguments(*verb);
    const auto out = std::make_shared<std::filesystem::path>();
    verb->add_option("--out", *out, "netCDF file for the temperatures")->required();
    verb->callback([a, out] { solve_verb(*a, *out); });
}

}  // namespace diurna
