#pragma once

#include <filesystem>
#include <vector>

#include "scenes/job/plan/job_report.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/heat_report.hpp"
#include "scenes/job/run/manifest.hpp"
#include "scenes/job/run/stages.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// What was reported of the heat balance when it was solved, in this run or the one it is kept
/// from.
void report_heat(HeatReport heat, JobReport& report);

/// Temperatures that are given; solved instead if too many visible facets have a representative's
/// there. Throws InputError where they are not of this scene.
TemperatureField given_field(const Stages& stages, const Manifest& manifest,
                             const std::vector<ObserverInput>& chosen,
                             const std::filesystem::path& file, Progress& progress,
                             JobReport& report);

}  // namespace diurna
