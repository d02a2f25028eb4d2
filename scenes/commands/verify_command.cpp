#include "scenes/commands/verify_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "scenes/run/listed_outputs.hpp"

namespace diurna {

void add_verify_verb(CLI::App& app) {
    const auto folder = std::make_shared<std::filesystem::path>();
    CLI::App* verb =
        app.add_subcommand("verify", "whether a run's folder is what the run has left");
    verb->add_option("DIR", *folder, "of a run or a sweep")->required();
    verb->callback([folder] {
        const std::vector<std::string> lines = verify(*folder);
        for (const std::string& line : lines) fmt::print("{}\n", line);
        if (!lines.empty()) {
            throw std::runtime_error(fmt::format("{}: {} amiss", folder->string(), lines.size()));
        }
        fmt::print("{}: {} files, all as written\n", folder->string(),
                   listed_outputs(*folder).digest.size());
    });
}

}  // namespace diurna
