#include "scenes/job/store/heat_inputs.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "scenes/job/store/digest.hpp"

namespace diurna {

namespace {

/// NAME to SHA-256.
std::map<std::string, std::string> by_name(const std::string& lines) {
    std::map<std::string, std::string> found;
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) {
        const std::size_t blank = line.find(' ');
        if (blank != std::string::npos) found[line.substr(blank + 1)] = line.substr(0, blank);
    }
    return found;
}

}  // namespace

std::string heat_made_of(const Scene& scene, const std::vector<RunInput>& inputs) {
    std::string lines = fmt::format("{} {}", sha256(scene.said_but_for_pictures), scene_file_name);
    for (const RunInput& input : inputs) {
        const bool is_scene = input.path.lexically_normal() == scene.file.lexically_normal();
        if (is_scene || input.name.starts_with("data/")) continue;
        lines += fmt::format("\n{} {}", input.sha256, input.name);
    }
    return lines;
}

std::vector<std::string> changed_since(const std::string& then, const std::string& now) {
    const auto before = by_name(then);
    std::vector<std::string> changed;
    for (const auto& [name, sha256] : by_name(now)) {
        const auto found = before.find(name);
        if (found != before.end() && found->second != sha256) changed.push_back(name);
    }
    return changed;
}

}  // namespace diurna
