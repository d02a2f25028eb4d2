#include <toml++/toml.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/matter/read_library.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/keys/key_book.hpp"
#include "scenes/job/keys/keys_page.hpp"
#include "scenes/job/keys/keys_schema.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/point/point_job_file.hpp"

// scenes/KEYS.md and the schema say what the readers do.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::json;

const fs::path root = DIURNA_SOURCE_DIR;

const KeyBook& book() {
    static const KeyBook known = key_book();
    return known;
}

const KeyEntry& entry(const std::vector<KeyEntry>& entries, const std::string& path) {
    for (const KeyEntry& e : entries) {
        if (e.path() == path) return e;
    }
    FAIL("no key " << path);
    throw 0;
}

/// The files of the scenes that come with the program.
std::vector<fs::path> samples(const std::string& name) {
    std::vector<fs::path> found;
    for (const auto& folder : fs::directory_iterator(root / "scenes")) {
        if (fs::exists(folder.path() / name)) found.push_back(folder.path() / name);
    }
    REQUIRE_FALSE(found.empty());
    return found;
}

Json json_of(const std::string& text) {
    std::ostringstream out;
    out << toml::json_formatter{toml::parse(text)};
    return Json::parse(out.str());
}

bool is_of_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return value.is_number();
}

/// The first place at which a value breaks a schema; "" if it keeps it. Of draft 2020-12 only what
/// keys_schema writes.
std::string broken_at(const Json& value, const Json& schema, const std::string& path = "") {
    if (schema.contains("enum")) {
        for (const Json& word : schema["enum"]) {
            if (word == value) return "";
        }
        return path + ": no such word";
    }
    if (schema.contains("anyOf")) {
        std::string broken;
        for (const Json& one : schema["anyOf"]) {
            broken = broken_at(value, one, path);
            if (broken.empty()) return "";
        }
        return broken;
    }
    if (!is_of_type(value, schema.at("type"))) return path + ": no " + schema["type"].dump();
    if (value.is_number()) {
        if (schema.contains("minimum") && value < schema["minimum"]) return path + ": too small";
        if (schema.contains("maximum") && value > schema["maximum"]) return path + ": too large";
    }
    if (value.is_array()) {
        if (value.size() < schema.value("minItems", std::size_t{0})) return path + ": too few";
        if (value.size() > schema.value("maxItems", value.size())) return path + ": too many";
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string where = path + "[" + std::to_string(i) + "]";
            const std::string found = broken_at(value[i], schema["items"], where);
            if (!found.empty()) return found;
        }
    }
    if (!value.is_object()) return "";
    for (const Json& key : schema.value("required", Json::array())) {
        if (!value.contains(key.get<std::string>())) return path + ": without " + key.dump();
    }
    for (const auto& [key, inner] : value.items()) {
        const bool named = schema.contains("properties") && schema["properties"].contains(key);
        const Json& of_key = named ? schema["properties"][key] : schema["additionalProperties"];
        if (of_key.is_boolean()) return path + "." + key + ": unknown";
        const std::string found = broken_at(inner, of_key, path + "." + key);
        if (!found.empty()) return found;
    }
    return "";
}

}  // namespace

TEST_CASE("scenes/KEYS.md is what `diurna keys` prints", "[scenes][keys]") {
    INFO("print it anew: diurna keys > scenes/KEYS.md");
    CHECK(keys_page(book()) == read_text(root / "scenes" / "KEYS.md", 1u << 20));
}

TEST_CASE("every key says in one line what it means", "[scenes][keys]") {
    for (const auto& entries : {book().scene, book().column, book().material}) {
        CHECK(entries.size() > 20);
        for (const KeyEntry& e : entries) {
            CAPTURE(e.path());
            CHECK(e.kind != Key::Kind::tested);  // asked whether it is there, and never read
            CHECK_FALSE(e.says.empty());
            for (const std::string& line : e.says) {
                CHECK_FALSE(line.empty());
                CHECK(line.find_first_of("|\n") == std::string::npos);
            }
        }
    }
}

TEST_CASE("the page lists type, unit, default, range and dependencies of a key", "[scenes][keys]") {
    const KeyEntry& width = entry(book().scene, "building[].width_m");
    CHECK(width.kind == Key::Kind::number);
    CHECK(width.need == KeyEntry::Need::always);
    CHECK(width.ranges.at(0).most == 1000.0);
    CHECK(unit_of(width.name) == "m");
    CHECK(entry(book().scene, "observer[].picture_width_m").condition ==
          "projection = \"orthographic\"");
    CHECK(entry(book().scene, "observer[].horizontal_fov_deg").fallbacks ==
          std::vector<std::string>{"20", "180"});
    CHECK(entry(book().scene, "texture[].levels").condition ==
          "what = \"albedo\" or \"emissivity\"");
    CHECK(entry(book().scene, "object[].parts.NAME").kind == Key::Kind::name);
    CHECK(entry(book().column, "sky.linke_turbidity").condition == "sun = \"ineichen\"");
    CHECK(entry(book().material, "bottom.film_W_m2K").condition == "kind = \"interior\"");
    CHECK(unit_of("film_W_m2K") == "W/m²K");
    CHECK(unit_of("velocity_m_s") == "m/s");
    CHECK(unit_of("conductance_W_K") == "W/K");
    CHECK(unit_of("heat_capacity_J_K") == "J/K");
    CHECK(unit_of("flow_kg_s") == "kg/s");
    CHECK(unit_of("air_changes_per_h") == "1/h");
    CHECK(unit_of("volume_m3") == "m³");
    CHECK(unit_of("heat_W") == "W");
    CHECK(unit_of("inside_K") == "K");
    CHECK(unit_of("leaf_area").empty());
}

TEST_CASE("no reader reads a key that the page does not have", "[scenes][keys]") {
    // keys_of_page.hpp holds every document against the page.
    for (const fs::path& file : samples("scene.toml")) {
        // Measured weather is made by a script of the scene's, from a third-party file.
        std::vector<std::string> in_its_place;
        if (!fs::exists(file.parent_path() / "weather.csv")) {
            in_its_place = {"weather.file=\"../jacksboro/weather.csv\""};
        }
        read_scene(file, in_its_place);
    }
    for (const fs::path& file : samples("column.toml")) read_column_job(file);
    default_material_library();
}

TEST_CASE("the schema accepts the sample files and refuses mistakes", "[scenes][keys]") {
    const Json schema = Json::parse(keys_schema(book()));
    CHECK(schema["$schema"] == "https://json-schema.org/draft/2020-12/schema");
    const Json& of_scene = schema["$defs"]["scene"];
    const Json& of_column = schema["$defs"]["column"];
    const auto said_of = [](const fs::path& file, const Json& kind) {
        return broken_at(json_of(read_text(file, 1u << 20)), kind);
    };
    for (const fs::path& file : samples("scene.toml")) CHECK(said_of(file, of_scene) == "");
    for (const fs::path& file : samples("column.toml")) {
        CHECK(said_of(file, of_column) == "");
        CHECK(said_of(file, of_scene) != "");
    }

    const auto said = [&](const std::string& from, const std::string& to) {
        return broken_at(json_of(with(small_scene(), from, to)), of_scene);
    };
    CHECK(said("tolerance_m", "tolerance_m") == "");
    CHECK(said("tolerance_m", "tolerence_m") == ".terrain.tolerence_m: unknown");
    CHECK(said("width = 64", "width = 0") == ".observer[0].width: too small");
    CHECK(said("width = 64", "width = 64.5") == ".observer[0].width: no \"integer\"");
    CHECK(said("[0.0, 0.0, 1500.0, 45.0, 45.0]", "[0.0]") == ".ground[0].rectangle_m: too few");
    CHECK(said("[weather]", "[whether]") == ": without \"weather\"");
    CHECK(said("[weather]", "[atmosphere]\nprofile = \"MLSS\"\n[weather]") ==
          ".atmosphere.profile: no such word");
}
