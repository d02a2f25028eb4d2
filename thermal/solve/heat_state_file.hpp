#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/solve/heat_state.hpp"

namespace diurna {

/// Whose heat a state is: another scene's may not be gone on from. Both are texts that say the same
/// of the same scene; what they hold is the writer's to choose.
struct StateOwner {
    std::string mesh;                  // of facets and which of them share a material
    std::vector<std::string> columns;  // what lies below each material, "name: ..."
};

/// A state and when it was.
struct TimedState {
    Instant instant{};
    HeatState state{};
};

/// Writes netCDF, every number as it is: a whole file or none. Throws std::runtime_error with path
/// and reason.
void save_heat_state(const std::filesystem::path& file, const TimedState& state,
                     const StateOwner& owner);

/// Reads what save_heat_state wrote. Throws InputError, one line, if the file is missing, no such
/// file, holds numbers that are not finite or is of another owner (which it names: the mesh, or a
/// material's layers).
TimedState load_heat_state(const std::filesystem::path& file, const StateOwner& owner);

}  // namespace diurna
