#pragma once

#include <string>
#include <vector>

/// Texts that make the readers ask for every key they know: each kind of bottom, finish, texture,
/// projection, ... stands in one of them at least. They need not be right (files may be absent),
/// only whole: a reader that gains an alternative gains a table here. tests/scenes/keys_test.cpp
/// finds what was forgotten, if any text of a test has it.
namespace diurna {

extern const std::vector<std::string> scene_specimens;
extern const std::vector<std::string> column_specimens;
/// Libraries of materials.
extern const std::vector<std::string> material_specimens;

}  // namespace diurna
