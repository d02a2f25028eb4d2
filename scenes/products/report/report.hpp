#pragma once

#include <filesystem>

#include "scenes/job/plan/job_report.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Writes report.html into a run's folder: one self-contained page with a contact sheet of every
/// observer and band, diurnal curves and crossovers of the materials, what was computed and
/// skipped, errors, rays and seconds of every stage.
void write_report(const std::filesystem::path& folder, const Prepared& prepared,
                  const JobReport& report, const TemperatureField& field);

}  // namespace diurna
