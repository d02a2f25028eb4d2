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
const std::set<std::string> without_terrain = {"column",     "reduced_column", "heat_balance",
                                               "turbulence", "planck",         "sensor"};

// Start of an include -> the sources it may stand in (file names without folder).
const std::map<std::string, std::set<std::string>> homes = {
    {"assimp/", {"mesh_file.cpp"}},
    {"CGAL/", {"triangulate.cpp", "ground_mesh.cpp"}},
    {"OpenMesh/", {"object_mesh.cpp"}},
    {"embree", {"ray_scene.cpp"}},
    {"gdal",
     {"dem_file.cpp", "quiet_gdal.hpp", "land_cover.cpp", "raster_file.cpp", "texture_file.cpp"}},
    {"ogr", {"dem_file.cpp", "dem_crs.cpp", "land_cover.cpp", "texture_file.cpp"}},
    {"GeographicLib/", {"site.cpp"}},
    {"erfa", {"sun.cpp"}},
    {"OpenEXR/", {"exr.cpp"}},
    {"Imf", {"exr.cpp"}},
    {"png.h", {"quicklook.cpp", "png.cpp"}},
    {"toml++/", {"document.cpp"}},
    {"netcdf", {"temperature_field.cpp"}},
    {"tbb/", {"parallel.cpp"}},
    {"openssl/", {"digest.cpp"}},
    {"nlohmann/", {"annotations.cpp", "manifest.cpp", "modtran_other.cpp", "modtran_deck.cpp"}},
    {"CLI/", {"main.cpp"}},
};

struct Include {
    fs::path file;
    int line;
    std::string target;
    bool ours;
};

std::vector<Include> includes_of(const std::string& folder) {
    std::vector<Include> found;
    for (const auto& entry : fs::directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".cpp" && extension != ".hpp") continue;
        std::ifstream file(entry.path());
        std::string text;
        for (int line = 1; std::getline(file, text); ++line) {
            if (text.rfind("#include", 0) != 0) continue;
            const auto begin = text.find_first_of("<\"");
            const auto end = text.find_first_of(">\"", begin + 1);
            if (begin == std::string::npos || end == std::string::npos) continue;
            found.push_back(
                {entry.path(), line, text.substr(begin + 1, end - begin - 1), text[begin] == '"'});
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
            CAPTURE(include.file.string(), include.line, include.target);
            const std::string layer = include.target.substr(0, include.target.find('/'));
            CHECK(allowed.count(layer) == 1);  // ours are rooted at the repository
        }
    }
}

TEST_CASE("physics kernels know no terrain", "[layering]") {
    for (const auto& [folder, allowed] : may_include) {
        for (const Include& include : includes_of(folder)) {
            if (without_terrain.count(include.file.stem().string()) == 0) continue;
            CAPTURE(include.file.string(), include.line, include.target);
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
                CAPTURE(include.file.string(), include.line, include.target);
                CHECK(sources.count(include.file.filename().string()) == 1);
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
