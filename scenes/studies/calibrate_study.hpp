#pragma once

#include <filesystem>
#include <string>

#include "scenes/studies/study_request.hpp"
#include "thermal/point/calibrate.hpp"

namespace diurna {

/// Fits the numbers listed in [calibrate] of a column, for the verb and Python.
struct CalibrateRequest {
    std::string file;  // of the column, for messages
    ColumnWith column_with;
    std::filesystem::path out{};  // folder for the files; empty: no files
};

/// Its name is "calibrate". Throws InputError.
StudyFindings calibrate_study(const CalibrateRequest& request);

}  // namespace diurna
