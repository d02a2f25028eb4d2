#pragma once

#include <filesystem>
#include <vector>

#include "scenes/plan/job_report.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/report/curves.hpp"

namespace diurna {

/// Writes report.html into a run's folder: one self-contained page with a contact sheet of every
/// observer and band, diurnal curves and crossovers of the materials, what was computed and
/// skipped, errors, rays and seconds of every stage.
void write_report(const std::filesystem::path& folder, const Prepared& prepared,
                  const JobReport& report, const std::vector<Instant>& instants,
                  const std::vector<DiurnalCurve>& curves);

}  // namespace diurna
