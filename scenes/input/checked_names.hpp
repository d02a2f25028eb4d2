#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "materials/base/section.hpp"
#include "scenes/input/scene_places.hpp"

namespace diurna {

/// Which texture lies on what: by name.
struct TextureUses {
    std::map<std::string, std::string> of_object;  // the ground, polygons, buildings, objects
    std::map<std::string, std::string> of_material;
};

/// What the parts of a scene file need to know of the rest of it.
struct Reading {
    ScenePlaces places;
    Names materials{.what = "material", .known = {}};
    Names textures{.what = "texture", .known = {}, .where = " in [[texture]]"};
    Names trajectories{.what = "trajectory", .known = {}, .where = " in [[trajectory]]"};
    TextureUses texture_uses{};
    std::set<std::string> object_names{"ground"};

    /// The key `name` of an object; a mistake if another has it.
    std::string object(const Section& section, const char* says);
    /// The key `texture`, which lays one on what is called `on` among `uses`.
    void texture(const Section& section, std::map<std::string, std::string>& uses,
                 const std::string& on) const;
};

/// The keys `class` and `labelled`: what kind of thing an object is in labels (scenes/labels), ""
/// of one that has none.
std::string class_of(const Section& section, const Or<std::string>& fallback);

}  // namespace diurna
