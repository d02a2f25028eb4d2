#include "scenes/job/input/checked_names.hpp"

#include <fmt/format.h>

namespace diurna {

namespace fs = std::filesystem;

std::string Reading::object(const Section& section, const char* says) {
    const std::string name = section.text("name", says);
    if (!name.empty() && !object_names.insert(name).second) {
        section.mistake("name", fmt::format("a second object named \"{}\"", name));
    }
    return name;
}

void Reading::texture(const Section& section, std::map<std::string, std::string>& uses,
                      const std::string& on) const {
    const std::string texture = section.name_or("texture", "texture of the surface", "", textures);
    if (section.has("texture")) uses[on] = texture;
}

std::string class_of(const Section& section, const Or<std::string>& fallback) {
    const std::string kind = section.text_or(
        "class", "class of the object in annotations.json and other labels", fallback);
    const bool broken = kind.find_first_of("\n\r\t\"\\") != std::string::npos;
    if (section.has("class") && (kind.empty() || broken)) {
        section.mistake("class", "expected a name without line breaks");
    }
    const bool labelled = section.flag_or(
        "labelled",
        "whether the object has labels; false: it is visible in pictures but has no labels", true);
    return labelled ? kind : "";
}

}  // namespace diurna
