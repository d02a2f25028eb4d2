#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/document.hpp"
#include "scenes/job/input/scene.hpp"

namespace diurna {

/// Reads a scene file (TOML; scenes/jacksboro/scene.toml shows every part). Types, ranges and names
/// are checked here and every mistake of the file is reported at once, with file:line:column; the
/// files it names must exist within its confines (materials/base/confines.hpp). `settings` are
/// "key.path=value" and replace the file's values. Throws InputError.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {},
                 bool allow_outside = false);
/// The scene file with settings in place of its values, for read_scene(). Throws InputError.
Document scene_document(const std::filesystem::path& file, const std::vector<std::string>& settings,
                        const Confines& confines);
/// The same for a document, for which it calls finish().
Scene read_scene(const Document& document);

}  // namespace diurna
