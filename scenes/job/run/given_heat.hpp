#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/inputs.hpp"
#include "thermal/temperature_field.hpp"

/// Temperatures of an earlier run, for new pictures and studies.
namespace diurna {

struct GivenHeat {
    TemperatureField field;
    std::vector<std::string> warnings{};  // differences between their inputs and the present ones
};

/// Reads them. Throws InputError if they are of another scene: of other facets, places, materials,
/// objects or weather. Other changed inputs, including the scene file beyond its observers, bands
/// and labels, are reported as a warning.
///
/// - inputs: run_inputs() of the scene
GivenHeat given_heat(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     const std::filesystem::path& file);

}  // namespace diurna
