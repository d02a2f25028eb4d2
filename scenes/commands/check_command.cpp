#include "scenes/commands/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/commands/printed_lines.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/plan/memory_limit.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/sweep/checked_scene.hpp"
#include "scenes/sweep/sweep_plan.hpp"
#include "scenes/sweep/variants.hpp"
#include "scenes/warnings/scene_warnings.hpp"

namespace diurna {

namespace {

std::string reported_count(const std::vector<std::string>& warnings) {
    return warnings.size() == 1 ? "1 warning" : fmt::format("{} warnings", warnings.size());
}

void check_verb(const SceneArguments& a, bool strict) {
    CheckedScene checked = check_scene(a.read(), a.settings, a.allow_outside);
    const std::vector<std::string> warnings = as_lines(checked.warnings);
    if (!checked.sweep.empty()) fmt::print("{}: {}\n", a.scene.string(), checked.sweep);
    if (strict && !checked.warnings.empty()) throw InputError(std::move(checked.warnings));
    fmt::print("{}: {}, {} facets, {} observers\n", a.scene.string(),
               warnings.empty() ? "fine" : reported_count(warnings), checked.facets,
               checked.observers);
    print_warnings(warnings);
    print_notes(checked.notes);
    if (const double most = free_memory(); most > 0.0 && checked.memory > most) {
        fmt::print(stderr,
                   "note: a run would be refused here: {:.1f} GB by the plan, {:.1f} free\n",
                   checked.memory / 1e9, most / 1e9);
    }
}

}  // namespace

void add_check_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("check", "every mistake of a scene file at once");
    const auto a = scene_arguments(*verb);
    const auto strict = std::make_shared<bool>(false);
    verb->add_flag("--strict", *strict, "warnings are mistakes: exit code 2");
    verb->callback([a, strict] { check_verb(*a, *strict); });
}

void add_plan_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("plan", "what would be computed and what is skipped");
    verb->callback([a = scene_arguments(*verb)] {
        const Prepared prepared = prepare(a->read());
        if (!prepared.scene.sweep.axes.empty()) {
            fmt::print("{}", describe(read_sweep_variants(a->scene, a->settings, a->allow_outside),
                                      prepared.plan));
        }
        fmt::print("{}", describe(prepared.plan));
        print_warnings(as_lines(scene_warnings(prepared)));
        print_notes(prepared.notes);
    });
}

}  // namespace diurna
