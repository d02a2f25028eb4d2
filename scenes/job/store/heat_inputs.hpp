#pragma once

#include <string>
#include <vector>

#include "scenes/job/store/inputs.hpp"

/// Inputs from which a scene's temperatures were computed, for their file: a line "SHA-256 NAME"
/// for the scene file, without the tables used only by pictures, and for each other input except
/// the program's own data.
namespace diurna {

std::string heat_made_of(const Scene& scene, const std::vector<RunInput>& inputs);

/// Names of inputs in `now` that differ from `then`.
///
/// - then: heat_made_of() when the temperatures were computed; "" gives nothing
std::vector<std::string> changed_since(const std::string& then, const std::string& now);

/// Name of the scene file in these lines.
inline constexpr const char* scene_file_name = "scene file";

}  // namespace diurna
