#include "scenes/input/checked_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"

namespace diurna {

namespace fs = std::filesystem;

fs::path Reading::file(const Section& section, const std::string& key) const {
    const std::string name = section.text(key);
    const fs::path path = folder / name;
    if (!name.empty() && !fs::is_regular_file(path)) {
        section.mistake(key, fmt::format("no such file: {}", path.string()));
    }
    return path;
}

std::string Reading::material(const Section& section, const std::string& key,
                              const std::string& fallback) const {
    if (!section.has(key)) {
        if (fallback.empty()) section.mistake(key, "missing, expected a material's name");
        return fallback;
    }
    const std::string name = section.text(key);
    if (std::find(materials.begin(), materials.end(), name) == materials.end()) {
        section.mistake(key, fmt::format("no material \"{}\"", name),
                        did_you_mean(name, materials));
    }
    return name;
}

std::string Reading::object(const Section& section) {
    const std::string name = section.text("name");
    if (!name.empty() && !object_names.insert(name).second) {
        section.mistake("name", fmt::format("a second object named \"{}\"", name));
    }
    return name;
}

Eigen::Vector2d place(const Section& section, const std::string& key) {
    const std::vector<double> at = section.numbers(key, 2);
    return {at[0], at[1]};
}

}  // namespace diurna
