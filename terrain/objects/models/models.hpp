#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/objects/mesh_file.hpp"

/// Objects built by code, by name: vehicles, plant, buildings, an aircraft.
namespace diurna {

enum class Detail { low, medium, high };

/// Their names, in the order of the table.
std::vector<std::string> model_names();

/// A description in one line; the name must be known.
std::string model_line(const std::string& name);

/// Whether it is built vertical on any slope (buildings, the mast); false for an unknown name.
bool stands_upright(const std::string& name);

/// Its mesh in metres, z up, front towards +y: closed solids side by side, facing outward, with 2
/// 000 to 20 000 triangles from low to high detail; parts have names (`node`) and no material.
/// Throws InputError for a name that is not in the table.
MeshFile model_mesh(const std::string& name, Detail detail);

/// The file that describes its parts (scenes/job/input/read_target.hpp): materials, rooms, engine.
std::filesystem::path model_part_file(const std::string& name);

}  // namespace diurna
