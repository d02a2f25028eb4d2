#pragma once

#include <array>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/input/read_terrain.hpp"

namespace diurna {

/// What of a scene is compared with something else.
struct RegionInput {
    enum class Kind { object, part, material, pixels };
    Kind kind = Kind::material;
    std::string name{};            // in words
    std::string object{}, part{};  // of an object: ground polygons and buildings are some, too
    std::string material{};        // all that is made of it
    std::array<int, 4> pixels{};   // left, top, width, height of a rectangle in the picture
    std::string where{};           // in the scene file
};

/// Bands that begin here or later see surfaces by their own heat, by night, too.
inline constexpr double heat_begins_um = 2.9;

/// What a region may be called in a scene.
struct RegionNames {
    Names all;
    std::vector<std::string> objects, materials;
};
RegionNames region_names(const TerrainInput& terrain, const std::vector<std::string>& materials);

inline constexpr const char* region_says =
    "an object, a building, a polygon of the ground, \"ground\" for the rest of the ground, "
    "OBJECT/PART, or a material (material:NAME where another has the same name)";

/// One of those names as what it stands for.
RegionInput region_named(const std::string& name, const RegionNames& known);

}  // namespace diurna
