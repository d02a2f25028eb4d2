#include "scenes/commands/calibrate_command.hpp"

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
#include "materials/base/files_read.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/studies/calibrate_files.hpp"
#include "thermal/point/calibrate.hpp"
#include "thermal/point/point_job_file.hpp"

namespace diurna {

namespace {

struct CalibrateArguments {
    std::filesystem::path file, out = "calibrate";
    std::vector<std::string> settings;
    bool allow_outside = false;
};

constexpr const char* name = "calibrate";

void calibrate_verb(const CalibrateArguments& a) {
    const std::filesystem::path curve = a.out / (std::string(name) + "_curve.csv");
    {
        const FilesRead opened;
        const PointJob job = read_column_job(a.file, a.allow_outside, a.settings);
        if (job.calibrate) note_file_read(job.calibrate->file);
        check_study_files(a.out, {name, std::string(name) + "_curve"}, opened.files());
    }
    const CalibrationReport report = calibrate(a.file, a.settings, a.allow_outside);
    write_study_files(a.out, name, calibration_texts(report));
    write_whole_file(curve, calibrated_curve_csv(report));
    const Fit& fit = report.fit;
    fmt::print("{} values, {} columns run: rms {:.3f} K before, {:.3f} K after\n",
               report.measured.size(), fit.runs, fit.rms_before, fit.rms);
    for (std::size_t i = 0; i < report.asked.sought.size(); ++i) {
        const FittedNumber& found = fit.number[i];
        fmt::print("  {} = {:.5g}", plain(report.asked.sought[i].key), found.value);
        fmt::print("{}\n", found.at_bound
                               ? std::string(", at its bound")
                               : fmt::format(", 95 % {:.5g} to {:.5g}", found.least, found.most));
        for (std::size_t j = 0; j < i; ++j) {
            if (found.at_bound || fit.number[j].at_bound) continue;
            fmt::print("    correlation with {}: {:+.3f}\n", plain(report.asked.sought[j].key),
                       fit.correlation[i][j]);
        }
    }
    fmt::print("{}.csv, .json, .svg, _curve.csv\n", (a.out / name).string());
    print_notes(report.notes);
    if (!fit.converged) {
        throw std::runtime_error(
            fmt::format("the numbers have not settled in {} passes", fit.passes));
    }
    if (!report.heat_converged) {
        throw std::runtime_error("the spin-up of a column has not converged");
    }
}

}  // namespace

void add_calibrate_verb(CLI::App& app) {
    const auto a = std::make_shared<CalibrateArguments>();
    CLI::App* verb = app.add_subcommand(
        "calibrate", "numbers of a column file found from a measured curve: [calibrate]");
    verb->add_option("COLUMN", a->file, "column file (TOML) with a table [calibrate]")->required();
    verb->add_option("--out", a->out, "folder for the results (default: calibrate)");
    verb->add_option("--set", a->settings,
                     "key=value in place of what the file says: material.albedo=0.2");
    verb->add_flag("--allow-outside", a->allow_outside,
                   "read files beyond the column's folder and the program's data");
    verb->callback([a] { calibrate_verb(*a); });
}

}  // namespace diurna
