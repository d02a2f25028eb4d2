#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "materials/base/section.hpp"
#include "scenes/job/input/scene_places.hpp"

namespace diurna {

/// Textures by the name of the material or object they are on.
struct TextureUses {
    std::map<std::string, std::string> of_object;  // the ground, polygons, buildings, objects
    std::map<std::string, std::string> of_material;
};

/// Context for reading the parts of a scene file.
struct Reading {
    ScenePlaces places;
    Names materials{.what = "material", .known = {}};
    Names textures{.what = "texture", .known = {}, .where = " in [[texture]]"};
    Names trajectories{.what = "trajectory", .known = {}, .where = " in [[trajectory]]"};
    TextureUses texture_uses{};
    std::set<std::string> object_names{"ground"};

    /// The key `name` of an object; a mistake if the name is already used.
    std::string object(const Section& section, const char* says);
    /// The key `texture`, which puts one on the thing named `on` in `uses`.
    void texture(const Section& section, std::map<std::string, std::string>& uses,
                 const std::string& on) const;
};

/// The keys `class` and `labelled`: an object's class in labels (scenes/products/labels), ""
/// without labels.
std::string class_of(const Section& section, const Or<std::string>& fallback);

}  // namespace diurna
