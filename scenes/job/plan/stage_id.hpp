#pragma once

#include <string>

namespace diurna {

/// Stages of a job, in their order. Plan, progress and report name them by this.
enum class StageId {
    terrain,
    sky_view,
    shadows,
    heat_balance,
    surface_check,
    write_temperatures,
    views,
    frames,
    instruments,
    labels,
    report,
    named,  // a part of a study or a sweep, called by the text beside it
};

/// Its name in plan and report: "sky view".
std::string name_of(StageId stage);

/// Its name during a run, with what it works on: "cast view of east", "frames of east". `named`
/// ones are called by `what` alone.
std::string name_of(StageId stage, const std::string& what);

}  // namespace diurna
