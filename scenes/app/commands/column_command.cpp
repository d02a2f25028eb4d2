#include "scenes/app/commands/column_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/plain_text.hpp"
#include "thermal/point/point_csv.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/point/spin_up.hpp"
#include "thermal/weather/weather_warnings.hpp"

namespace diurna {

namespace {

struct ColumnArguments {
    std::filesystem::path file;
    std::filesystem::path out;  // empty: to stdout
    std::vector<std::string> settings;
    bool allow_outside = false;
};

PointResult followed(const PointJob& job, const std::filesystem::path& file) {
    try {
        return run_column(job);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(
            fmt::format("{}: the facet of its [material]: {}", file.string(), error.what()));
    }
}

void column_verb(const ColumnArguments& a) {
    const FilesRead opened;
    const PointJob job = read_column_job(a.file, a.allow_outside, a.settings);
    if (!a.out.empty()) check_output_file(a.out, opened.files());
    // Of the weather: what is implausible.
    for (const Mistake& warning : weather_warnings(job.weather, job.site, job.start, job.end,
                                                   a.file.string() + ": weather.file")) {
        fmt::print(stderr, "warning: {}\n", plain(warning.line()));
    }
    const PointResult result = followed(job, a.file);
    const std::string text = column_csv(result);
    if (a.out.empty()) {
        fmt::print("{}", text);
    } else {
        write_whole_file(a.out, text);
        fmt::print(stderr, "{}, {}, periodic to {:.1e} K, energy balance closed to {:.1e}\n",
                   number_of(result.row.size(), "row"), number_of(result.passes, "pass", "passes"),
                   result.periodic_residual, result.worst_energy_closure);
    }
    if (result.store_held) {
        fmt::print(
            stderr,
            "note: water, hoar or snow changes by {:.2g} mm from day to day: the start is the "
            "state after eight such days\n",
            result.standing_residual);
    }
    if (!result.note.empty()) fmt::print(stderr, "note: {}\n", plain(result.note));
    if (result.converged) return;
    throw std::runtime_error(fmt::format(
        "the spin-up has not converged in {} passes: error {:.1e} K (limit {:.0e} K, "
        "time.tolerance_K), water on the surface changes by {:.1e} mm a day; reduce "
        "time.longest_step_s, or set time.spin_up = \"none\" with an earlier time.start",
        result.passes, result.periodic_error, job.tolerance, result.standing_residual));
}

}  // namespace

void add_column_verb(CLI::App& app) {
    const auto a = std::make_shared<ColumnArguments>();
    CLI::App* verb =
        app.add_subcommand("column", "temperatures of one facet driven by a weather file");
    verb->add_option("COLUMN", a->file, "column file (TOML)")->required();
    verb->add_option("--out", a->out, "CSV file of results (default: standard output)");
    verb->add_option("--set", a->settings,
                     "KEY=VALUE replaces a value of the file: material.albedo=0.2");
    verb->add_flag("--allow-outside", a->allow_outside,
                   "permit input files outside the column file's folder and the program's data");
    verb->callback([a] { column_verb(*a); });
}

}  // namespace diurna
