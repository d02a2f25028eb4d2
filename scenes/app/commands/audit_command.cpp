#include "scenes/app/commands/audit_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "scenes/app/commands/number_option.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/job/run/audit.hpp"

namespace diurna {

namespace {

struct AuditArguments {
    std::filesystem::path folder;
    int checks = 2000;
    SceneArguments scene;
};

void audit_verb(AuditArguments& a) {
    const AuditedRun run = audited_run(a.folder);
    a.scene.scene = run.scene;
    a.scene.settings = run.settings;
    const Audit found = audit(run, a.scene.read(), a.checks, a.scene.style());
    if (!found.same_inputs) {
        print_notes(
            {fmt::format("{}: inputs or the program changed since the run; this is the "
                         "error of the scene as it is now",
                         a.folder.string())});
    }
    for (const std::string& line : audit_lines(found)) fmt::print("{}\n", line);
    if (!found.not_converged.empty()) throw std::runtime_error(found.not_converged);
}

}  // namespace

void add_audit_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "audit", "measure the error of a run's temperatures at many places of its pictures");
    const auto a = std::make_shared<AuditArguments>();
    verb->add_option("DIR", a->folder, "folder of a complete run")->required();
    whole_within(verb->add_option("--checks", a->checks,
                                  "places in pictures to solve separately (default: 2000)"),
                 1, 4096);
    add_common_options(*verb, a->scene);
    verb->callback([a] { audit_verb(*a); });
}

}  // namespace diurna
