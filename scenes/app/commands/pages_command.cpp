#include "scenes/app/commands/pages_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "scenes/app/commands/bill_of_materials.hpp"
#include "scenes/app/commands/command_pages.hpp"

namespace diurna {

void add_pages_verb(CLI::App& app) {
    CLI::App* verb =
        app.add_subcommand("pages", "print the manual page, bash completion or list of libraries");
    struct Asked {
        bool man = false, bash = false, bill = false;
    };
    const auto asked = std::make_shared<Asked>();
    auto* which = verb->add_option_group("page");
    which->add_flag("--man", asked->man, "print the manual page (view with man -l)");
    which->add_flag("--bash", asked->bash, "print the bash completion script (load with source)");
    which->add_flag("--bill", asked->bill,
                    "print the libraries of the program as CycloneDX 1.4 JSON");
    which->require_option(1);
    verb->callback([asked, &app] {
        if (asked->man) fmt::print("{}", man_page(app, DIURNA_VERSION));
        if (asked->bash) fmt::print("{}", bash_completion(app));
        if (asked->bill) fmt::print("{}\n", bill_of_materials());
    });
}

}  // namespace diurna
