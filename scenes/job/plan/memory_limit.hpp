#pragma once

#include <string>

#include "scenes/job/plan/plan.hpp"

namespace diurna {

/// Bytes of a text: "800M", "6.5G", "2T" (powers of 1000). Throws InputError for
/// --max-memory.
double bytes_reported(const std::string& text);
/// "320 MB", "6.5 GB".
std::string memory_in_words(double bytes);

/// Memory available on the machine [bytes]: nine tenths of the free memory, within the limit of the
/// process's control group; 0: not known.
double free_memory();

/// Throws InputError if a plan needs more than that, with both numbers and the largest items.
///
/// - limit: [bytes] from --max-memory; 0: free_memory()
void check_memory(const Plan& plan, double limit);

}  // namespace diurna
