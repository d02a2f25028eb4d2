#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "materials/base/document_nodes.hpp"
#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/section.hpp"

namespace diurna {

namespace {

/// What may have been meant by the name of a file that is not there.
std::string file_hint(const std::filesystem::path& file, const std::string& name) {
    if (name.find('\\') != name.npos) return "use '/' between folders";
    std::vector<std::string> there;
    std::error_code problem;
    for (const auto& entry : std::filesystem::directory_iterator(
             file.has_parent_path() ? file.parent_path() : ".", problem)) {
        there.push_back(entry.path().filename().string());
        if (there.size() >= 1000) break;
    }
    std::sort(there.begin(), there.end());
    return did_you_mean(file.filename().string(), there);
}

}  // namespace

std::filesystem::path Section::file(const std::string& key, const char* says) const {
    return file_named(key, text(key, says));
}

std::vector<std::filesystem::path> Section::files(const std::string& key, const char* says) const {
    const toml::node* node = node_of(table_, key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    const bool asked = ask(key, says, Key::Kind::files, {.required = true});
    std::vector<std::filesystem::path> found;
    if (!asked) {
        missing(key, "a file name in quotes, or an array of file names");
    } else if (array == nullptr) {
        found.push_back(file_named(key, checked_text(key, "")));
    } else if (array->empty() ||
               !all_of_them(*array, [](const auto& one) { return one.is_string(); })) {
        mistake(key, fmt::format("found {}, expected a file name or an array of file names",
                                 array->empty() ? "an empty array" : shown(*node)));
    } else {
        for (const toml::node& one : *array) {
            const std::string name = one.as_string()->get();
            if (!is_plain(name)) {
                mistake(key,
                        fmt::format("found {}, expected a file name without control characters",
                                    shown(one)));
                continue;
            }
            found.push_back(file_named(key, name));
        }
    }
    std::erase_if(found, [](const auto& file) { return file.empty(); });
    return found;
}

std::filesystem::path Section::file_named(const std::string& key, const std::string& name) const {
    const std::string path = joined_path(path_, key);
    const bool reported = std::any_of(state_->mistakes.begin(), state_->mistakes.end(),
                                      [&](const auto& mistake) { return mistake.path == path; });
    if (missed_ || reported) return {};
    std::filesystem::path file = std::filesystem::path(state_->file).parent_path() / name;
    std::error_code problem;
    if (name.empty()) {
        mistake(key, "found \"\", expected a file name");
    } else if (const std::string why = why_not(state_->confines, file); !why.empty()) {
        mistake(key, fmt::format("{} {}", file.string(), why), allow_outside_hint);
    } else if (!std::filesystem::exists(file, problem)) {
        mistake(key, fmt::format("no such file: {}", file.string()), file_hint(file, name));
    } else {
        return file;
    }
    return {};
}

const Confines& Section::confines() const { return state_->confines; }

}  // namespace diurna
