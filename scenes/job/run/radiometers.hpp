#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/run/heat_report.hpp"
#include "scenes/job/run/stages.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// The files of a scene's radiometers: "radiometer_NAME.csv".
std::vector<std::string> radiometer_files(const Scene& scene);

/// Writes them into a folder: a row for each step of the heat balance, in W m⁻²: irradiance of a
/// receiver of 1 cm² in each direction, from the heat balance's own sun, sky and facets
/// (thermal/received_light.hpp), by 4096 rays a direction, 64 to the sun's disc.
///
/// - result: of the scene, with heat balances at every step
///
/// - report: gets a row for each radiometer with the ranges of its irradiance, and a note for each
///   one whose view includes much that is not modelled
void write_radiometers(const Stages& stages, const SpanResult& result,
                       const std::filesystem::path& folder, HeatReport& report);

}  // namespace diurna
