#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "materials/base/least_squares.hpp"
#include "terrain/place/instant.hpp"
#include "thermal/point/calibration.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

/// A column fitted to a measured curve.
struct CalibrationReport {
    Calibration asked;
    std::vector<Instant> when;     // instants of the measured values within the span
    std::vector<double> measured;  // [K]
    std::size_t beyond = 0;        // rows before or after the span, skipped
    std::size_t missing = 0;       // empty cells
    Fit fit;                       // its `before` and `after` [K]
    std::vector<std::string> notes{};
    bool heat_converged = true;  // of every column that was run
};

/// The column, with settings "key=value" in place of the file's values.
using ColumnWith = std::function<PointJob(const std::vector<std::string>& more)>;

/// Fits the numbers listed in [calibrate] of a column file, by runs of the column with different
/// values. Temperatures are linear between rows of the result (time.step_s). Throws InputError for
/// an invalid problem: a file without [calibrate], numbers without effect, a curve of fewer values
/// than numbers, bounds at which the column cannot be read.
///
/// - file: name for messages
CalibrationReport calibrate(const std::string& file, const ColumnWith& column_with);
/// - settings: "key=value" given on the command line
CalibrationReport calibrate(const std::filesystem::path& file,
                            const std::vector<std::string>& settings, bool allow_outside);

}  // namespace diurna
