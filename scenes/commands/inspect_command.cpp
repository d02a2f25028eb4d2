#include "scenes/commands/inspect_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "scenes/export/inspect.hpp"

namespace diurna {

namespace {

struct InspectArguments {
    std::filesystem::path file;
    bool json = false;
    InspectOptions options;
};

}  // namespace

void add_inspect_verb(CLI::App& app) {
    const auto a = std::make_shared<InspectArguments>();
    CLI::App* verb = app.add_subcommand("inspect", "what a file holds, and what to call next");
    verb->add_option("FILE", a->file, "any input or output of the program; a run's folder")
        ->required();
    verb->add_flag("--json", a->json, "as one JSON object");
    verb->add_flag("--allow-outside", a->options.allow_outside,
                   "read files beside it that lie elsewhere");
    verb->callback([a] {
        const Found found = inspect(a->file, a->options);
        fmt::print("{}", a->json ? found_json(a->file.string(), found) : found_text(found));
    });
}

}  // namespace diurna
