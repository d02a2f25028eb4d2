#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Brings what runs of one scene have left in folders of their own, each a part of its pictures,
/// into one folder with a ledger of all, as if one run had been ended there before its labels.
/// Files are shared with the parts where the file system can (hard links).
///
/// - key: of the run (job_key()), as all parts must have it
/// - expected: files that the parts must have between them
///
/// Throws InputError, before anything is written, for a part of other inputs, one that is still
/// being written, files that are not what their run has left or not the same in two parts, and for
/// what is in none.
void gather_parts(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out,
                  const std::string& key, const std::vector<std::string>& expected);

}  // namespace diurna
