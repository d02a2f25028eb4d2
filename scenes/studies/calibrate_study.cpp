#include "scenes/studies/calibrate_study.hpp"

#include <fmt/format.h>

#include <utility>

#include "materials/base/files_read.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/studies/calibrate_files.hpp"

namespace diurna {

namespace {

constexpr const char* name = "calibrate";

std::string reported(const CalibrationReport& report) {
    const Fit& fit = report.fit;
    std::string text = fmt::format("{}, {}: rms {:.3f} K before, {:.3f} K after\n",
                                   number_of(report.measured.size(), "measured value"),
                                   number_of(fit.runs, "column run"), fit.rms_before, fit.rms);
    for (std::size_t i = 0; i < report.asked.sought.size(); ++i) {
        const FittedNumber& found = fit.number[i];
        text += fmt::format("  {} = {:.5g}", plain(report.asked.sought[i].key), found.value);
        text += found.at_bound ? std::string(", at its bound\n")
                               : fmt::format(", 95 % {:.5g} to {:.5g}\n", found.least, found.most);
        for (std::size_t j = 0; j < i; ++j) {
            if (found.at_bound || fit.number[j].at_bound) continue;
            text += fmt::format("    correlation with {}: {:+.3f}\n",
                                plain(report.asked.sought[j].key), fit.correlation[i][j]);
        }
    }
    return text;
}

std::string what_has_not_settled(const CalibrationReport& report) {
    if (!report.fit.converged) {
        return fmt::format(
            "the fit has not converged in {} passes; use narrower bounds in [calibrate] or fit "
            "fewer values",
            report.fit.passes);
    }
    return report.heat_converged
               ? ""
               : "the spin-up of a column has not converged; reduce time.longest_step_s, or set "
                 "time.spin_up = \"none\" with an earlier time.start";
}

}  // namespace

StudyFindings calibrate_study(const CalibrateRequest& request) {
    if (!request.out.empty()) {
        const FilesRead opened;
        const PointJob job = request.column_with({});
        if (job.calibrate) note_file_read(job.calibrate->file);
        check_study_files(request.out, {name, std::string(name) + "_curve"}, opened.files());
    }
    const CalibrationReport report = calibrate(request.file, request.column_with);
    StudyFinding found{.name = name,
                       .texts = calibration_texts(report),
                       .reported = reported(report),
                       .notes = report.notes};
    if (!request.out.empty()) write_study_files(request.out, name, found.texts);
    return {.finding = {std::move(found)}, .not_converged = what_has_not_settled(report)};
}

}  // namespace diurna
