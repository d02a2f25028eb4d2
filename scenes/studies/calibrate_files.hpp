#pragma once

#include "scenes/studies/study_files.hpp"
#include "thermal/point/calibrate.hpp"

namespace diurna {

/// The files of a column's calibration: CSV of its numbers (a line each, with their correlations),
/// JSON of all, SVG of the curves; "_curve.csv" of time,measured_K,before_K,after_K.
StudyTexts calibration_texts(const CalibrationReport& report);

}  // namespace diurna
