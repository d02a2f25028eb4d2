#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "materials/base/document.hpp"

namespace diurna {

/// What the parts of a scene file need to know of the rest of it.
struct Reading {
    std::filesystem::path folder;  // relative names of files start here
    std::vector<std::string> materials;
    std::set<std::string> object_names;

    /// The file a key names; a mistake if there is none.
    std::filesystem::path file(const Section& section, const std::string& key) const;
    /// The material a key names, or else `fallback`; a mistake if there is neither.
    std::string material(const Section& section, const std::string& key,
                         const std::string& fallback = "") const;
    /// The name of an object; a mistake if another has it.
    std::string object(const Section& section);
};

/// East and north of the site [m].
Eigen::Vector2d place(const Section& section, const std::string& key);

}  // namespace diurna
