#pragma once

#include <filesystem>
#include <vector>

namespace diurna {

/// Throws InputError if a sweep cannot be written to a folder: as check_run_folder(), in use,
/// with an input in it, or with another file in the folder of a variant or a heat balance. Writes
/// nothing.
///
/// - inputs: of the scene
/// - shared: with shards of the same sweep, which may be at work there
void check_sweep_folder(const std::filesystem::path& out,
                        const std::vector<std::filesystem::path>& inputs, bool shared);

}  // namespace diurna
