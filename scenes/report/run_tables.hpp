#pragma once

#include <string>

#include "scenes/plan/job_report.hpp"
#include "scenes/plan/prepared.hpp"

/// What a page reports of a run in tables, each as HTML.
namespace diurna {

/// Place, facets, frames, how the heat balance began and whether it has converged.
std::string facts_table(const Prepared& prepared, const JobReport& report);

/// Errors that the run knows of, measured or bounded, with what they were found by.
std::string errors_table(const Prepared& prepared, const JobReport& report);

/// Seconds of every stage as the plan thought and as it took, and rays.
std::string timings_table(const JobReport& report);

/// What the plan computes and skips, why, and what that costs.
std::string decisions_table(const Plan& plan);

/// What was modelled for want of data, and what else a reader should know.
std::string notes_list(const JobReport& report);

/// Files that the results depend on, with SHA-256.
std::string inputs_table(const JobReport& report);

}  // namespace diurna
