#pragma once

#include <string>
#include <vector>

#include "scenes/job/plan/plan.hpp"

namespace diurna {

/// A decision in words: what is computed or skipped, why, and the error of that.
struct PlanRow {
    std::string what;
    bool computed = true;
    std::string why;
    double error = 0.0;      // upper bound; 0: exact
    std::string error_unit;  // "K", "W m-2", "W m-2 sr-1"
};
std::vector<PlanRow> plan_rows(const Plan& plan);

/// "17 views, 34 pictures, 16 instants": a view is an observer at an instant, a picture a view in a
/// band.
std::string picture_counts(const Plan& plan);

/// The text printed by `diurna plan`.
std::string describe(const Plan& plan);

}  // namespace diurna
