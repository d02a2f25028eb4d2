#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene.hpp"

namespace diurna {

/// Reads the scene with additional settings "key=value". Throws InputError.
using SceneWith = std::function<Scene(const std::vector<std::string>&)>;

/// That of a file.
///
/// - settings: come before the additional ones
SceneWith reads_scene(std::filesystem::path file, std::vector<std::string> settings,
                      bool allow_outside);

std::string setting(const std::string& key, double value);

/// What is wrong with the scene with those; nothing if it can be read.
///
/// - where: position of the request in the scene file
std::optional<Mistake> mistake_with(const SceneWith& scene_with,
                                    const std::vector<std::string>& settings,
                                    const std::string& where);

/// Reads the scene with those. Throws InputError at `where` if it cannot be read.
///
/// - where: position of the request in the scene file
Scene scene_with_settings(const SceneWith& scene_with, const std::vector<std::string>& settings,
                          const std::string& where);

}  // namespace diurna
