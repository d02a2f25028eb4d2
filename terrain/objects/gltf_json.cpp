#include "terrain/objects/gltf_json.hpp"

#include <fmt/format.h>

namespace diurna {

namespace {

constexpr int most_nesting = 100;  // of JSON; the format needs a dozen

/// Brackets within brackets, texts aside: what reads JSON calls itself, too.
void check_nesting(const std::string& name, std::string_view json) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > most_nesting) {
            throw InputError(
                name, fmt::format("its JSON is nested more than {} levels deep", most_nesting));
        }
    }
}

}  // namespace

Gltf::Gltf(const std::string& name, std::string_view json) : name_(name) {
    check_nesting(name, json);
    all_ = nlohmann::json::parse(json.begin(), json.end(), nullptr, false);
    if (!all_.is_object()) throw InputError(name, "has no JSON object");
    const nlohmann::json& version = member(member(all_, "asset"), "version");
    const std::string reported =
        version.is_string() ? version.get<std::string>() : version.dump().substr(0, 40);
    if (reported.starts_with("2.") || reported == "2") return;
    throw InputError(name, fmt::format("has glTF version '{}', expected 2", reported),
                     "export it as glTF 2");
}

}  // namespace diurna
