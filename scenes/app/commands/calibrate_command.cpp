#include "scenes/app/commands/calibrate_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/app/commands/study_commands.hpp"
#include "scenes/studies/calibrate_study.hpp"
#include "thermal/point/point_job_file.hpp"

namespace diurna {

namespace {

struct CalibrateArguments {
    std::filesystem::path file, out = "calibrate";
    std::vector<std::string> settings;
    bool allow_outside = false;
};

void calibrate_verb(const CalibrateArguments& a) {
    const StudyFindings found = calibrate_study(
        {.file = a.file.string(),
         .column_with =
             [&](const std::vector<std::string>& more) {
                 return read_column_job(a.file, a.allow_outside, joined(a.settings, more));
             },
         .out = a.out});
    tell(found, a.out);
}

}  // namespace

void add_calibrate_verb(CLI::App& app) {
    const auto a = std::make_shared<CalibrateArguments>();
    CLI::App* verb =
        app.add_subcommand("calibrate", "fit material properties to a measured curve: [calibrate]");
    verb->add_option("COLUMN", a->file, "column file (TOML) with a table [calibrate]")->required();
    verb->add_option("--out", a->out, "folder for the results (default: calibrate)");
    verb->add_option("--set", a->settings,
                     "KEY=VALUE replaces a value of the file: material.albedo=0.2");
    verb->add_flag("--allow-outside", a->allow_outside,
                   "permit input files outside the column file's folder and the program's data");
    verb->callback([a] { calibrate_verb(*a); });
}

}  // namespace diurna
