#pragma once

#include <filesystem>
#include <string>

/// Folders of a sweep in messages: which one a command needs (scenes/app/sweep/run_sweep.hpp).
namespace diurna {

/// Remedy for a command that needs a run's pictures, if the folder is that of a sweep: names a
/// variant's folder. "" for other folders.
std::string variant_hint(const std::filesystem::path& folder);

/// The same for a command that needs temperatures, if the folder is that of a sweep or of one of
/// its variants: names the folder of the common heat balance.
std::string heat_hint(const std::filesystem::path& folder);

/// The folder of the sweep, if the folder is one of its variants or of its heat balances; else "".
std::filesystem::path sweep_around(const std::filesystem::path& folder);

/// Whether the folder is that of a sweep, complete or not.
bool is_sweep_folder(const std::filesystem::path& folder);

}  // namespace diurna
