#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Checks of a folder's files against its lists.
namespace diurna {

/// The files of a run or a sweep by its manifest.json.
struct ListedOutputs {
    bool found = false;                   // a manifest.json written by diurna
    bool done = false;                    // the run is complete
    std::filesystem::path scene{};        // of a run: its scene file
    std::vector<std::string> settings{};  // of its command line, and of its rounds
    /// Rounds (scenes/job/run/rounds.hpp): text and settings of each.
    std::vector<std::pair<std::string, std::vector<std::string>>> rounds{};
    std::string key{};                            // of a run: job_key()
    std::map<std::string, std::string> digest{};  // SHA-256 by name, relative to the folder
    std::vector<std::filesystem::path> inputs{};  // of a run, as it named them
};
ListedOutputs listed_outputs(const std::filesystem::path& folder);

/// Whether a run, finished or not, has written there.
bool is_listed(const std::filesystem::path& folder);

/// Whether all of these exist in a folder with that content: SHA-256 by name.
bool is_whole(const std::filesystem::path& folder,
              const std::map<std::string, std::string>& digests);

/// A line for each file that is missing, changed, or not listed although it is among listed ones;
/// none if the folder is unchanged since its run. Throws InputError if it is not a folder.
std::vector<std::string> verify(const std::filesystem::path& folder);

}  // namespace diurna
