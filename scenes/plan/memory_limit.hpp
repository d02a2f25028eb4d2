#pragma once

#include <string>

#include "scenes/plan/plan.hpp"

namespace diurna {

/// Bytes that a text reports: "800M", "6.5G", "2T" (powers of 1000). Throws InputError, of
/// --max-memory.
double bytes_reported(const std::string& text);

/// What the machine can still give [bytes]: nine tenths of what is free to be taken, within the
/// limit of the process's control group; 0: the system does not say.
double free_memory();

/// Throws InputError where a plan needs more than that, with both numbers and what takes most.
///
/// - limit: [bytes] as --max-memory has it; 0: free_memory()
void check_memory(const Plan& plan, double limit);

}  // namespace diurna
