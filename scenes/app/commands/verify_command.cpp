#include "scenes/app/commands/verify_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "materials/base/number_of.hpp"
#include "scenes/job/run/listed_outputs.hpp"

namespace diurna {

void add_verify_verb(CLI::App& app) {
    const auto folder = std::make_shared<std::filesystem::path>();
    CLI::App* verb =
        app.add_subcommand("verify", "check that a run's folder holds exactly what the run wrote");
    verb->add_option("DIR", *folder, "folder of a run or a sweep")->required();
    verb->callback([folder] {
        const std::vector<std::string> lines = verify(*folder);
        for (const std::string& line : lines) fmt::print("{}\n", line);
        if (lines.size() == 1 && lines.front().find("not complete") != std::string::npos) {
            throw std::runtime_error(
                fmt::format("{}: incomplete; its files are unchanged so far", folder->string()));
        }
        if (!lines.empty()) {
            throw std::runtime_error(fmt::format("{}: {} missing or changed", folder->string(),
                                                 number_of(lines.size(), "file")));
        }
        fmt::print("{}: {}, unchanged since the run\n", folder->string(),
                   number_of(listed_outputs(*folder).digest.size(), "file"));
    });
}

}  // namespace diurna
