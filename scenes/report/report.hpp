#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scenes/plan/job_report.hpp"
#include "scenes/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Rows of a page on the quality of the heat balance's solution: names and values.
std::vector<std::pair<std::string, std::string>> heat_rows(const SolveReport& solve);

/// Writes report.html into a run's folder: one self-contained page with a contact sheet of every
/// observer and band, diurnal curves and crossovers of the materials, what was computed and
/// skipped, errors, rays and seconds of every stage.
void write_report(const std::filesystem::path& folder, const Prepared& prepared,
                  const JobReport& report, const TemperatureField& field);

}  // namespace diurna
