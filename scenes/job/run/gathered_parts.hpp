#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Merges runs of one scene in separate folders, each with a part of its pictures, into one folder
/// with a ledger of all, as if one run had been stopped there before its labels. Files are shared
/// with the parts if the file system allows it (hard links).
///
/// - key: of the run (job_key()), the same for all parts
/// - expected: files that the parts must have together
///
/// Throws InputError, before anything is written, for a part with other inputs, one that is still
/// being written, files that differ from their run's or between two parts, and for files that are
/// in no part.
void gather_parts(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out,
                  const std::string& key, const std::vector<std::string>& expected);

}  // namespace diurna
