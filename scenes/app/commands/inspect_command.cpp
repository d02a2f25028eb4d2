#include "scenes/app/commands/inspect_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "scenes/products/export/inspect.hpp"

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
    CLI::App* verb =
        app.add_subcommand("inspect", "describe a file's contents and suggest the next command");
    verb->add_option("FILE", a->file, "any input or output file of the program, or a run's folder")
        ->required();
    verb->add_flag("--json", a->json, "print one JSON object");
    verb->add_flag("--allow-outside", a->options.allow_outside,
                   "permit input files outside the file's folder");
    verb->callback([a] {
        const Found found = inspect(a->file, a->options);
        fmt::print("{}", a->json ? found_json(a->file.string(), found) : found_text(found));
    });
}

}  // namespace diurna
