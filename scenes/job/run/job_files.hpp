#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/plan/job_report.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/manifest.hpp"

/// What a run begins with: the report before anything is computed, and an emptied folder.
namespace diurna {

/// What the heat balance leaves in the folder; nothing where temperatures are given.
///
/// - given: temperatures are
std::vector<std::string> heat_files(const Scene& scene, bool given);

/// The same and the pictures of some of its observers.
std::vector<std::string> run_files(const Scene& scene, const std::vector<ObserverInput>& chosen,
                                   bool given);

/// The report before anything is computed.
///
/// - files: of the heat balance
JobReport begun_report(const Prepared& prepared, const Manifest& manifest,
                       std::vector<std::string> files);

/// Makes room for what the ledger has not, and begins it. What is reported of it goes to the
/// report.
void begin_folder(const std::vector<std::string>& expected, const std::filesystem::path& out,
                  const Ledger& ledger, Progress& progress, JobReport& report);

/// What --resume has reused, and why where that is nothing.
std::string resumed(const std::filesystem::path& out, const std::string& earlier,
                    const std::string& key, bool temperatures, std::size_t reused, std::size_t all);

}  // namespace diurna
