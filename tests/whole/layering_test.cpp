#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// The map of the README: data flows one way between the five folders, between the rooms of each and
// between units (a source and the header of its name), each third-party library lives in few files,
// and what comments and pages name is there.

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

// The rooms of each folder from low to high: one may include itself and those before it. A source
// beside the rooms is a room of its own.
const std::map<std::string, std::vector<std::string>> rooms = {
    {"materials", {"base", "radiation", "matter", "air", "modtran", "atmosphere"}},
    {"terrain",
     {"place", "raster", "ground", "objects", "facets", "relief", "visibility", "texture"}},
    {"thermal",
     {"netcdf", "weather", "weather_file", "column", "surface", "kernels", "steppers", "network",
      "point", "covered_facets", "heat_flux_field", "temperature_names", "temperature_field",
      "field_difference", "temperature_reader", "temperature_mesh", "received_light", "solve"}},
    {"render",
     {"picture", "instrument", "detection", "view", "light", "path", "eye", "rays", "tracer"}},
    {"scenes",
     {"job/input", "job/keys", "job/world", "job/plan", "job/warnings", "job/store", "charts",
      "products/labels", "products/report", "job/run", "app/sweep", "studies", "products/export",
      "app/commands"}},
};

// Units that still include each other, directly or around. To become empty.
const std::set<std::string> circles_to_be_mended = {};

// Physics that takes numbers and spans, and is tested without a mesh.
const std::set<std::string> without_terrain = {
    "thermal/column", "thermal/kernels", "thermal/network", "thermal/steppers", "thermal/surface"};

// Start of an include -> the sources it may stand in.
const std::map<std::string, std::set<std::string>> homes = {
    {"CGAL/", {"terrain/ground/triangulate.cpp", "terrain/ground/cut_network.hpp"}},
    {"OpenMesh/", {"terrain/objects/mesh_check.cpp"}},
    {"embree", {"terrain/visibility/embree_scene.hpp"}},
    {"gdal",
     {"terrain/raster/band_mask.hpp", "terrain/raster/class_raster.cpp",
      "terrain/raster/dem_file.cpp", "terrain/raster/dem_heights.hpp",
      "terrain/raster/gdal_file.hpp", "terrain/raster/gdal_gate.cpp", "terrain/raster/geotiff.cpp",
      "terrain/raster/land_shapes.cpp", "terrain/raster/quiet_gdal.hpp",
      "terrain/raster/raster_facts.cpp", "terrain/raster/raster_reference.hpp",
      "terrain/texture/texture_file.cpp"}},
    {"ogr",
     {"terrain/raster/class_raster.cpp", "terrain/raster/crs.hpp", "terrain/raster/dem_file.cpp",
      "terrain/raster/dem_heights.cpp", "terrain/raster/dem_notes.cpp", "terrain/raster/geoid.cpp",
      "terrain/raster/land_shapes.cpp", "terrain/raster/raster_reference.hpp"}},
    {"GeographicLib/", {"terrain/place/site.cpp"}},
    {"erfa", {"terrain/place/celestial.cpp"}},
    {"OpenEXR/", {"render/picture/exr.cpp"}},
    {"Imf", {"render/picture/exr.cpp"}},
    {"fftw3.h", {"render/instrument/convolution.cpp"}},
    {"tiffio.h", {"render/picture/grey_tiff.cpp"}},
    {"png.h",
     {"render/picture/colour_png.cpp", "render/picture/grey_png.cpp",
      "render/picture/quicklook.cpp"}},
    {"toml++/", {"materials/base/document_state.hpp"}},
    {"netcdf",
     {"thermal/netcdf/netcdf_reader.cpp", "thermal/netcdf/netcdf_writer.hpp",
      "thermal/temperature_field.cpp", "thermal/solve/heat_state_file.cpp"}},
    {"hdf5.h", {"materials/base/hdf5_file.cpp"}},
    {"tbb/", {"materials/base/parallel.cpp"}},
    {"openssl/", {"scenes/job/store/digest.cpp"}},
    {"nlohmann/",
     {"scenes/products/labels/attribute_json.hpp",
      "scenes/products/labels/coco.cpp",
      "scenes/job/keys/keys_schema.cpp",
      "scenes/job/plan/progress.cpp",
      "scenes/products/report/study_plots.cpp",
      "scenes/job/run/manifest.cpp",
      "scenes/job/run/ledger.cpp",
      "scenes/job/run/listed_outputs.cpp",
      "scenes/app/sweep/records.cpp",
      "scenes/app/sweep/merged_labels.cpp",
      "scenes/app/commands/bill_of_materials.cpp",
      "scenes/products/export/found_json.cpp",
      "scenes/products/export/inspect_json.cpp",
      "scenes/studies/calibrate_files.cpp",
      "scenes/studies/contrast_files.cpp",
      "scenes/studies/crossover_files.cpp",
      "scenes/studies/detection_files.cpp",
      "scenes/studies/sensitivity_files.cpp",
      "scenes/studies/signature_files.cpp",
      "scenes/studies/study_request.cpp",
      "materials/modtran/modtran6.cpp",
      "materials/modtran/deck.cpp",
      "terrain/objects/gltf_json.hpp"}},
    {"boost/crc", {"scenes/products/export/zip_file.cpp"}},
    {"boost/geometry", {"terrain/ground/ring_index.cpp"}},
    {"boost/math/", {"materials/base/least_squares.cpp", "scenes/studies/crossings.cpp"}},
    {"CLI/",
     {"scenes/app/commands/main.cpp",
      "scenes/app/commands/audit_command.cpp",
      "scenes/app/commands/calibrate_command.cpp",
      "scenes/app/commands/check_command.cpp",
      "scenes/app/commands/column_command.cpp",
      "scenes/app/commands/doctor_command.cpp",
      "scenes/app/commands/export_command.cpp",
      "scenes/app/commands/inspect_command.cpp",
      "scenes/app/commands/help_page.cpp",
      "scenes/app/commands/keys_command.cpp",
      "scenes/app/commands/materials_command.cpp",
      "scenes/app/commands/model_command.cpp",
      "scenes/app/commands/movie_command.cpp",
      "scenes/app/commands/new_command.cpp",
      "scenes/app/commands/number_option.cpp",
      "scenes/app/commands/command_pages.cpp",
      "scenes/app/commands/pages_command.cpp",
      "scenes/app/commands/path_command.cpp",
      "scenes/app/commands/raster_commands.cpp",
      "scenes/app/commands/reshade_command.cpp",
      "scenes/app/commands/scene_arguments.cpp",
      "scenes/app/commands/run_command.cpp",
      "scenes/app/commands/solve_command.cpp",
      "scenes/app/commands/slurm_command.cpp",
      "scenes/app/commands/study_commands.cpp",
      "scenes/app/commands/sun_command.cpp",
      "scenes/app/commands/verify_command.cpp"}},
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

std::string folder_of(const std::string& file) { return file.substr(0, file.find('/')); }

/// "place" of terrain/place/sun.hpp, "job/run" of scenes/job/run/heat.hpp, "facets" of
/// terrain/facets.hpp.
std::string room_of(const std::string& file) {
    const std::string inner = file.substr(file.find('/') + 1);
    const auto slash = inner.rfind('/');
    return slash == std::string::npos ? inner.substr(0, inner.find('.')) : inner.substr(0, slash);
}

/// A source and the header of its name.
std::string unit_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

/// Height of a room in its folder; −1 if the table above does not have it.
int height_of(const std::string& file) {
    const auto& low_to_high = rooms.at(folder_of(file));
    const std::string room = room_of(file);
    const auto found = std::find_if(low_to_high.begin(), low_to_high.end(), [&](const auto& name) {
        return room == name || room.rfind(name + "/", 0) == 0;  // or a folder of the room
    });
    return found == low_to_high.end() ? -1 : int(found - low_to_high.begin());
}

/// Files that git tracks; empty where there is no git.
std::vector<std::string> tracked_files() {
    const std::string command = "git -C '" + root.string() + "' ls-files 2>/dev/null";
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> block{};
    while (const std::size_t count = pipe ? fread(block.data(), 1, block.size(), pipe) : 0) {
        text.append(block.data(), count);
    }
    if (pipe) pclose(pipe);
    std::vector<std::string> files;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (fs::exists(root / line)) files.push_back(line);
    }
    return files;
}

/// Whether `from` includes itself around others.
bool in_circle(const std::string& from, const std::map<std::string, std::set<std::string>>& graph) {
    std::set<std::string> seen;
    std::vector<std::string> open{from};
    while (!open.empty()) {
        const auto next = graph.find(open.back());
        open.pop_back();
        if (next == graph.end()) continue;
        for (const std::string& unit : next->second) {
            if (unit == from) return true;
            if (seen.insert(unit).second) open.push_back(unit);
        }
    }
    return false;
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

TEST_CASE("rooms of a folder include only rooms below them", "[layering]") {
    for (const auto& [folder, low_to_high] : rooms) {
        for (const Include& include : includes_of(folder)) {
            if (!include.ours || folder_of(include.target) != folder) continue;
            CAPTURE(include.file, include.line, include.target);
            CHECK(height_of(include.file) >= 0);  // add a new room to the table, at its height
            CHECK(height_of(include.target) <= height_of(include.file));
        }
    }
}

TEST_CASE("no unit includes itself around others", "[layering]") {
    std::map<std::string, std::set<std::string>> graph;
    for (const auto& [folder, allowed] : may_include) {
        for (const Include& include : includes_of(folder)) {
            const std::string unit = unit_of(include.file);
            if (include.ours && unit_of(include.target) != unit) {
                graph[unit].insert(unit_of(include.target));
            }
        }
    }
    for (const auto& [unit, includes] : graph) {
        if (circles_to_be_mended.count(unit) == 1) continue;
        CAPTURE(unit, includes);
        CHECK_FALSE(in_circle(unit, graph));
    }
}

TEST_CASE("files that comments and pages name are there", "[layering]") {
    const std::regex name(
        R"((^|[^\w/.<-])((materials|terrain|thermal|render|scenes|tests|bench)/[\w./-]*\.(hpp|cpp|toml|md|sh|py)))");
    const std::vector<std::string> files = tracked_files();
    if (files.empty()) WARN("not checked: git does not list the files");
    for (const std::string& path : files) {
        const std::string extension = fs::path(path).extension();
        const bool code = extension == ".cpp" || extension == ".hpp";
        if (!code && extension != ".md" && extension != ".toml") continue;
        std::ifstream file(root / path);
        std::string text;
        for (int line = 1; std::getline(file, text); ++line) {
            const std::size_t comment = code ? text.find("//") : 0;
            if (comment == std::string::npos) continue;
            const std::string words = text.substr(comment);
            for (std::sregex_iterator it(words.begin(), words.end(), name), end; it != end; ++it) {
                CAPTURE(path, line);
                const std::string named = (*it)[2];
                CAPTURE(named);
                CHECK(fs::exists(root / named));
            }
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
    const std::set<std::string> house = {"CMakeLists.txt", "terrain",
                                         "thermal",        "materials",
                                         "render",         "scenes",
                                         "tests",          "bench",
                                         "README.md",      "setup.sh",
                                         "demo.sh",        "test.sh",
                                         "LICENSE",        "CMakePresets.json",
                                         ".clang-format",  ".clang-tidy",
                                         ".gitignore",     ".ci",
                                         "SECURITY.md",    "packaging",
                                         "python",         "docs",
                                         "pyproject.toml", "CONTRIBUTING.md",
                                         "CHANGELOG.md",   "CITATION.cff"};
    const std::vector<std::string> files = tracked_files();
    if (files.empty()) WARN("not checked: git does not list the files");
    for (const std::string& file : files) {
        CAPTURE(file);
        CHECK(house.count(file.substr(0, file.find('/'))) == 1);
    }
    for (const std::string& name : house) {
        CAPTURE(name);
        CHECK(fs::exists(root / name));
    }
}
