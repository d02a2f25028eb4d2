#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/products/export/inspect.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

long long size_of(const Json& json, const char* key) {
    return json.contains(key) ? static_cast<long long>(json[key].size()) : 0;
}

std::string json_text(const Json& json, const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

Found manifest(const Json& json, const std::filesystem::path& file) {
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    const bool sweep = json.contains("variants");
    Found found{.kind = sweep ? "manifest of a sweep" : "manifest of a run"};
    found.fact = {{"program", {json_text(json, "program")}}, {"scene", {json_text(json, "scene")}}};
    if (sweep) {
        found.fact.push_back({"variants", {size_of(json, "variants")}});
        found.fact.push_back({"heat_balances", {size_of(json, "heats")}});
        found.next = fmt::format("diurna verify {}", folder);
        const Json& first = json["variants"].is_array() && !json["variants"].empty()
                                ? json["variants"].front()
                                : Json::object();
        if (first.is_object() && !json_text(first, "folder").empty()) {
            found.next += fmt::format(
                "; the pictures of each variant are in its folder: diurna movie {0}/{1}; the "
                "temperatures: diurna export {0}/heat/{2} --to csv --out curves.csv",
                folder, json_text(first, "folder"), json_text(first, "heat"));
        }
        return found;
    }
    found.fact.push_back({"state", {json_text(json, "state")}});
    if (!json_text(json, "not_converged").empty()) {
        found.fact.push_back({"not_converged", {json_text(json, "not_converged")}});
    }
    if (size_of(json, "span") == 2 && json["span"][0].is_string() && json["span"][1].is_string()) {
        found.fact.push_back(
            {"span", {json["span"][0].get<std::string>(), json["span"][1].get<std::string>()}});
    }
    found.fact.push_back({"frames", {size_of(json, "frames")}});
    found.fact.push_back({"cameras", {size_of(json, "cameras")}});
    found.fact.push_back({"inputs", {size_of(json, "inputs")}});
    found.fact.push_back({"outputs", {size_of(json, "outputs")}});
    found.next =
        fmt::format("diurna verify {0}; diurna export {0} --to csv --out curves.csv", folder);
    return found;
}

Found annotations(const Json& json) {
    Found found{.kind = "labels (COCO)"};
    found.fact = {{"images", {size_of(json, "images")}},
                  {"annotations", {size_of(json, "annotations")}}};
    FoundTable classes{"categories", {"id", "name"}, {}};
    for (const Json& one : json["categories"]) {
        if (!one.is_object() || !one.contains("id") || !one["id"].is_number_integer()) continue;
        classes.row.push_back({one["id"].get<long long>(), json_text(one, "name")});
    }
    found.table.push_back(std::move(classes));
    found.next = "file names are relative to its own folder; readers of COCO accept it";
    return found;
}

}  // namespace

Found inspect_json(const std::filesystem::path& file) {
    const Json json = Json::parse(read_text(file, std::size_t{1} << 30), nullptr, false);
    if (json.is_discarded()) throw InputError(file.string(), "is not valid JSON");
    if (json.is_object() && json_text(json, "program").starts_with("diurna")) {
        return manifest(json, file);
    }
    if (json.is_object() && json.contains("annotations") && json.contains("categories") &&
        json["categories"].is_array()) {
        return annotations(json);
    }
    if (json.is_object() && json_text(json, "type") == "FeatureCollection") {
        return {
            .kind = "shapes (GeoJSON)",
            .fact = {{"features", {size_of(json, "features")}}},
            .table = {},
            .next = "use it as file of shapes of a scene's terrain; diurna keys lists the keys"};
    }
    throw InputError(file.string(), "is JSON, but not a manifest, COCO labels or GeoJSON");
}

}  // namespace diurna
