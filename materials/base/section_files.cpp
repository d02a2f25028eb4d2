#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "materials/base/document_nodes.hpp"
#include "materials/base/section.hpp"

namespace diurna {

std::filesystem::path Section::file(const std::string& key, const char* says) const {
    return file_named(key, text(key, says));
}

std::filesystem::path Section::file_named(const std::string& key, const std::string& name) const {
    const std::string path = joined_path(path_, key);
    const bool told = std::any_of(state_->mistakes.begin(), state_->mistakes.end(),
                                  [&](const auto& mistake) { return mistake.path == path; });
    if (missed_ || told) return {};
    std::filesystem::path file = std::filesystem::path(state_->file).parent_path() / name;
    std::error_code problem;
    if (name.empty()) {
        mistake(key, "found \"\", expected the name of a file");
    } else if (const std::string why = why_not(state_->confines, file); !why.empty()) {
        mistake(key, fmt::format("{} {}", file.string(), why), allow_outside_hint);
    } else if (!std::filesystem::exists(file, problem)) {
        mistake(key, fmt::format("no such file: {}", file.string()));
    } else {
        return file;
    }
    return {};
}

const Confines& Section::confines() const { return state_->confines; }

}  // namespace diurna
