#pragma once

#include <string>
#include <vector>

#include "scenes/cache/inputs.hpp"

/// What a scene's temperatures were made of, for their file to say: a line "SHA-256 NAME" for the
/// scene file, without the tables that only pictures are made of, and for each other input, the
/// program's own data skipped.
namespace diurna {

std::string heat_made_of(const Scene& scene, const std::vector<RunInput>& inputs);

/// Names of what is there and now is not what temperatures were made of.
///
/// - then: heat_made_of() of when they were; "" reports nothing
std::vector<std::string> changed_since(const std::string& then, const std::string& now);

/// The name in these lines of the scene file.
inline constexpr const char* scene_file_name = "scene file";

}  // namespace diurna
