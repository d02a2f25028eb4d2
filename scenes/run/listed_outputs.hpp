#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What a folder's own lists say of its files.
namespace diurna {

/// The files of a run or a sweep by its manifest.json.
struct ListedOutputs {
    bool found = false;                           // a manifest.json that diurna has written
    bool done = false;                            // of a run that came to its end
    std::map<std::string, std::string> digest{};  // SHA-256 by name, relative to the folder
};
ListedOutputs listed_outputs(const std::filesystem::path& folder);

/// Whether a run has written there, ended or not.
bool is_listed(const std::filesystem::path& folder);

/// Whether all of these stand in a folder with that content: SHA-256 by name.
bool is_whole(const std::filesystem::path& folder,
              const std::map<std::string, std::string>& digests);

/// A line for each file that is gone, changed, or not listed though it stands among those that are;
/// none where the folder is what its run has left. Throws InputError for what is no folder.
std::vector<std::string> verify(const std::filesystem::path& folder);

}  // namespace diurna
