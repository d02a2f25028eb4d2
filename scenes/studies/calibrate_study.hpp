#pragma once

#include <filesystem>
#include <string>

#include "scenes/studies/study_request.hpp"
#include "thermal/point/calibrate.hpp"

namespace diurna {

/// Numbers of a column that are asked for by [calibrate], as the verb and Python do.
struct CalibrateRequest {
    std::string file;  // of the column, to tell of mistakes
    ColumnWith column_with;
    std::filesystem::path out{};  // folder for the files; empty: none is written
};

/// Its name is "calibrate". Throws InputError.
StudyFindings calibrate_study(const CalibrateRequest& request);

}  // namespace diurna
