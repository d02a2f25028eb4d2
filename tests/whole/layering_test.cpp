#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

// The map of the README: data flows one way, and each third-party library lives in few files.

namespace {

namespace fs = std::filesystem;

const fs::path root = DIURNA_SOURCE_DIR;

const std::map<std::string, std::set<std::string>> may_include = {
    {"materials", {"materials"}},
    {"terrain", {"materials", "terrain"}},
    {"thermal", {"materials", "terrain", "thermal"}},
    {"render", {"materials", "terrain", "render"}},
    {"scenes", {"materials", "terrain", "thermal", "render", "scenes"}},
};

// Physics that takes numbers and spans, and is tested without a mesh.
const std::set<std::string> without_terrain = {"thermal/column", "thermal/kernels",
                                               "thermal/steppers", "thermal/surface"};

// Start of an include -> the sources it may stand in.
const std::map<std::string, std::set<std::string>> homes = {
    {"assimp/", {"terrain/objects/mesh_file.cpp"}},
    {"CGAL/", {"terrain/ground/triangulate.cpp", "terrain/ground/ground_mesh.cpp"}},
    {"OpenMesh/", {"terrain/objects/object_mesh.cpp"}},
    {"embree", {"terrain/visibility/ray_scene.cpp"}},
    {"gdal",
     {"terrain/raster/dem_file.cpp", "terrain/raster/quiet_gdal.hpp",
      "terrain/raster/land_cover.cpp", "terrain/raster/raster_file.cpp",
      "terrain/texture/texture_file.cpp"}},
    {"ogr",
     {"terrain/raster/dem_file.cpp", "terrain/raster/dem_crs.cpp", "terrain/raster/land_cover.cpp",
      "terrain/texture/texture_file.cpp"}},
    {"GeographicLib/", {"terrain/place/site.cpp"}},
    {"erfa", {"terrain/place/sun.cpp"}},
    {"OpenEXR/", {"render/picture/exr.cpp"}},
    {"Imf", {"render/picture/exr.cpp"}},
    {"png.h", {"render/picture/quicklook.cpp"}},
    {"toml++/", {"materials/base/document.cpp"}},
    {"netcdf", {"thermal/temperature_field.cpp"}},
    {"tbb/", {"materials/base/parallel.cpp"}},
    {"openssl/", {"scenes/run/digest.cpp"}},
    {"nlohmann/",
     {"scenes/report/annotations.cpp", "scenes/run/manifest.cpp", "materials/modtran/modtran6.cpp",
      "materials/modtran/deck.cpp"}},
    {"CLI/",
     {"scenes/commands/main.cpp", "scenes/commands/column_command.cpp",
      "scenes/commands/doctor_command.cpp", "scenes/commands/path_command.cpp",
      "scenes/commands/raster_commands.cpp", "scenes/commands/scene_commands.cpp",
      "scenes/commands/sun_command.cpp"}},
};

struct Include {
    std::string file;  // from the root
    int line;
    std::string target;
    bool ours;
};

std::vector<Include> includes_of(const std::string& folder) {
    std::vector<Include> found;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".cpp" && extension != ".hpp") continue;
        std::ifstream file(entry.path());
        std::string text;
        for (int line = 1; std::getline(file, text); ++line) {
            if (text.rfind("#include", 0) != 0) continue;
            const auto begin = text.find_first_of("<\"");
            const auto end = text.find_first_of(">\"", begin + 1);
            if (begin == std::string::npos || end == std::string::npos) continue;
            found.push_back({entry.path().lexically_relative(root), line,
                             text.substr(begin + 1, end - begin - 1), text[begin] == '"'});
        }
    }
    return found;
}

}  // namespace

TEST_CASE("includes follow the map", "[layering]") {
    for (const auto& [folder, allowed] : may_include) {
        const std::vector<Include> includes = includes_of(folder);
        REQUIRE_FALSE(includes.empty());
        for (const Include& include : includes) {
            if (!include.ours) continue;
            CAPTURE(include.file, include.line, include.target);
            const std::string layer = include.target.substr(0, include.target.find('/'));
            CHECK(allowed.count(layer) == 1);  // ours are rooted at the repository
        }
    }
}

TEST_CASE("physics kernels know no terrain", "[layering]") {
    for (const auto& [folder, allowed] : may_include) {
        for (const Include& include : includes_of(folder)) {
            const std::string room = include.file.substr(0, include.file.rfind('/'));
            if (without_terrain.count(room) == 0) continue;
            CAPTURE(include.file, include.line, include.target);
            CHECK(include.target.rfind("terrain/", 0) != 0);
        }
    }
}

TEST_CASE("third-party libraries stay in their sources", "[layering]") {
    for (const auto& [folder, allowed] : may_include) {
        for (const Include& include : includes_of(folder)) {
            if (include.ours) continue;
            for (const auto& [start, sources] : homes) {
                if (include.target.rfind(start, 0) != 0) continue;
                CAPTURE(include.file, include.line, include.target);
                CHECK(sources.count(include.file) == 1);
            }
        }
    }
}

TEST_CASE("the top level is the house and nothing else", "[layering]") {
    const std::set<std::string> house = {
        "CMakeLists.txt", "terrain",    "thermal", "materials",         "render",
        "scenes",         "tests",      "bench",   "README.md",         "setup.sh",
        "demo.sh",        "test.sh",    "LICENSE", "CMakePresets.json", ".clang-format",
        ".clang-tidy",    ".gitignore", ".ci"};
    std::set<std::string> ignored = {".git", "out", ".cache", "compile_commands.json"};
    for (const auto& entry : fs::directory_iterator(root)) {
        const std::string name = entry.path().filename();
        if (name.rfind("build", 0) == 0 || ignored.count(name) == 1) continue;
        CAPTURE(name);
        CHECK(house.count(name) == 1);
    }
    for (const std::string& name : house) {
        CAPTURE(name);
        CHECK(fs::exists(root / name));
    }
}
