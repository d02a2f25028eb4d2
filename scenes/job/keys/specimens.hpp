#pragma once

#include <string>
#include <vector>

/// Texts that make the readers read every key they know: each kind of bottom, finish, texture,
/// projection, ... is in at least one of them. They need not be valid (files may be missing), only
/// complete: for a new alternative in a reader, add a table here. tests/scenes/keys_test.cpp finds
/// missing ones if any text of a test has them.
namespace diurna {

extern const std::vector<std::string> scene_specimens;
extern const std::vector<std::string> column_specimens;
/// Libraries of materials.
extern const std::vector<std::string> material_specimens;

}  // namespace diurna
