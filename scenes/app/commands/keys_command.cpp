#include "scenes/app/commands/keys_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "scenes/job/keys/key_book.hpp"
#include "scenes/job/keys/keys_page.hpp"
#include "scenes/job/keys/keys_schema.hpp"

namespace diurna {

void add_keys_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("keys", "print every key of scene and column files");
    const auto schema = std::make_shared<bool>(false);
    verb->add_flag("--schema", *schema, "print a JSON Schema, for editors with TOML support");
    verb->callback([schema] {
        const KeyBook book = key_book();
        fmt::print("{}", *schema ? keys_schema(book) : keys_page(book));
    });
}

}  // namespace diurna
