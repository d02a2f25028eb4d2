#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/plan/prepared.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/temperature_field.hpp"

/// Temperatures that an earlier run has left, for pictures and studies of now.
namespace diurna {

struct GivenHeat {
    TemperatureField field;
    std::vector<std::string> warnings{};  // what they were solved with otherwise
};

/// Reads them. Throws InputError where they are of another scene: of other facets, places,
/// materials, objects or weather. Other inputs that are not what they were, the scene file among
/// them beyond its observers, bands and labels, are reported as a warning.
GivenHeat given_heat(const Prepared& prepared, const std::filesystem::path& file);

/// Throws InputError for pictures of facets that the run of `file` left to others of their kind
/// (tolerance_K).
void check_solved(const Stages& stages, const TemperatureField& field,
                  const std::filesystem::path& file);

}  // namespace diurna
