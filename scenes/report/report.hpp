#pragma once

#include <filesystem>
#include <vector>

#include "scenes/report/curves.hpp"
#include "scenes/run/job.hpp"

namespace diurna {

/// Writes report.html into a run's folder: one self-contained page with a contact sheet of every
/// observer and band, diurnal curves and crossovers of the materials, what was computed and
/// skipped, errors, rays and seconds of every stage.
void write_report(const std::filesystem::path& folder, const Prepared& prepared,
                  const JobReport& report, const std::vector<Instant>& instants,
                  const std::vector<DiurnalCurve>& curves);

}  // namespace diurna
