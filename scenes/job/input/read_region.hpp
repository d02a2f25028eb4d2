#pragma once

#include <array>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/read_terrain.hpp"

namespace diurna {

/// Part of a scene that is compared with another one.
struct RegionInput {
    enum class Kind { object, part, material, pixels };
    Kind kind = Kind::material;
    std::string name{};            // description
    std::string object{}, part{};  // of an object: also ground polygons and buildings
    std::string material{};        // all facets of it
    std::array<int, 4> pixels{};   // left, top, width, height of a rectangle in the picture
    std::string where{};           // in the scene file
};

/// Bands from here on show surfaces by their thermal emission, also at night.
inline constexpr double heat_begins_um = 2.9;

/// Allowed names of regions in a scene.
struct RegionNames {
    Names all;
    std::vector<std::string> objects, materials;
};
RegionNames region_names(const TerrainInput& terrain, const std::vector<std::string>& materials);

inline constexpr const char* region_says =
    "an object, a building, a polygon of the ground, \"ground\" for the rest of the ground, "
    "OBJECT/PART, or a material (material:NAME where another has the same name)";

/// The region with one of those names.
RegionInput region_named(const std::string& name, const RegionNames& known);

}  // namespace diurna
