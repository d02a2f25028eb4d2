#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/solve/heat_state.hpp"

namespace diurna {

/// Identifies the scene of a state: a solve cannot continue from another scene's. Both texts are
/// equal for equal scenes; their content is chosen by the writer.
struct StateOwner {
    std::string mesh;                  // of facets, and facets that share a material
    std::vector<std::string> columns;  // layers of each material, "name: ..."
};

/// A state and its instant.
struct TimedState {
    Instant instant{};
    HeatState state{};
};

/// Writes netCDF with full precision: a whole file or none. Throws std::runtime_error with path
/// and reason.
void save_heat_state(const std::filesystem::path& file, const TimedState& state,
                     const StateOwner& owner);

/// Reads a file of save_heat_state. Throws InputError, one line, if the file is missing, of another
/// format, holds numbers that are not finite or has another owner (it names the difference: the
/// mesh, or a material's layers).
TimedState load_heat_state(const std::filesystem::path& file, const StateOwner& owner);

}  // namespace diurna
