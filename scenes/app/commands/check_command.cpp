#include "scenes/app/commands/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/app/sweep/checked_scene.hpp"
#include "scenes/app/sweep/sweep_plan.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/studies/checked_studies.hpp"
#include "scenes/studies/study_solves.hpp"

namespace diurna {

namespace {

void check_verb(const SceneArguments& a, bool strict) {
    const StudyRequest studies{
        .scene = a.scene, .settings = a.settings, .allow_outside = a.allow_outside};
    CheckedScene checked =
        check_scene(a.read(), a.settings, a.allow_outside,
                    [&](const Prepared& prepared) { check_studies(prepared, studies); });
    const std::vector<std::string> warnings = as_lines(checked.warnings);
    if (!checked.sweep.empty()) fmt::print("{}: {}\n", a.scene.string(), checked.sweep);
    if (strict && !checked.warnings.empty()) throw InputError(std::move(checked.warnings));
    fmt::print("{}: {}, {}, {}\n", a.scene.string(),
               warnings.empty() ? "no warnings" : number_of(warnings.size(), "warning"),
               number_of(checked.facets, "facet"), number_of(checked.observers, "observer"));
    print_warnings(warnings);
    print_notes(checked.notes);
    if (const double most = free_memory(); most > 0.0 && checked.memory > most) {
        fmt::print(stderr,
                   "note: this machine would refuse the run: the plan needs {} of memory, "
                   "{} are free\n",
                   memory_in_words(checked.memory), memory_in_words(most));
    }
}

}  // namespace

void add_check_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("check", "report every error and warning of a scene file");
    const auto a = scene_arguments(*verb);
    const auto strict = std::make_shared<bool>(false);
    verb->add_flag("--strict", *strict, "treat warnings as errors (exit code 2)");
    verb->callback([a, strict] { check_verb(*a, *strict); });
}

void add_plan_verb(CLI::App& app) {
    CLI::App* verb =
        app.add_subcommand("plan", "list the computations of a run, with time and memory");
    const auto a = scene_arguments(*verb);
    add_checks(*verb, a);
    verb->callback([a] {
        const Prepared prepared = prepare(a->read());
        if (!prepared.scene.sweep.axes.empty()) {
            fmt::print("{}", describe(read_sweep_variants(a->scene, a->settings, a->allow_outside),
                                      prepared.plan));
        }
        fmt::print("{}", describe(prepared.plan));
        fmt::print("{}", describe(study_solves(prepared.scene), prepared.plan));
        print_warnings(as_lines(scene_warnings(prepared)));
        print_notes(prepared.notes);
    });
}

}  // namespace diurna
