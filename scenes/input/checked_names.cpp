#include "scenes/input/checked_names.hpp"

#include <fmt/format.h>

namespace diurna {

namespace fs = std::filesystem;

fs::path Reading::file(const Section& section, const std::string& key, const char* says) const {
    const std::string name = section.text(key, says);
    const fs::path path = folder / name;
    if (!name.empty() && !fs::is_regular_file(path)) {
        section.mistake(key, fmt::format("no such file: {}", path.string()));
    }
    return path;
}

std::string Reading::object(const Section& section, const char* says) {
    const std::string name = section.text("name", says);
    if (!name.empty() && !object_names.insert(name).second) {
        section.mistake("name", fmt::format("a second object named \"{}\"", name));
    }
    return name;
}

void Reading::texture(const Section& section, std::map<std::string, std::string>& uses,
                      const std::string& on) const {
    const std::string texture =
        section.name_or("texture", "what varies on it from place to place", "", textures);
    if (section.has("texture")) uses[on] = texture;
}

Eigen::Vector2d place(const Section& section, const std::string& key, const char* says) {
    const std::vector<double> at = section.numbers(key, says, 2);
    return {at[0], at[1]};
}

}  // namespace diurna
