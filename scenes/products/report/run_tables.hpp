#pragma once

#include <string>

#include "scenes/job/plan/job_report.hpp"
#include "scenes/job/plan/prepared.hpp"

/// Tables of a page about a run, each as HTML.
namespace diurna {

/// Place, facets, frames, start of the heat balance and whether it converged.
std::string facts_table(const Prepared& prepared, const JobReport& report);

/// Known errors of the run, measured or bounded, and how they were obtained.
std::string errors_table(const Prepared& prepared, const JobReport& report);

/// Seconds of every stage, estimated and measured, and rays.
std::string timings_table(const JobReport& report);

/// Decisions of the plan: computed or skipped, why, and the cost.
std::string decisions_table(const Plan& plan);

/// Quantities modelled for lack of data, and other notes.
std::string notes_list(const JobReport& report);

/// Files that the results depend on, with SHA-256.
std::string inputs_table(const JobReport& report);

}  // namespace diurna
