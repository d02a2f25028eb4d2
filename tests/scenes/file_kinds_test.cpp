#include <catch2/catch.hpp>
#include <fstream>
#include <functional>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "thermal/point/point_job_file.hpp"

using namespace diurna;

namespace {

/// The mistakes of reading, one line each.
std::vector<std::string> mistakes(const std::function<void()>& read) {
    std::vector<std::string> lines;
    try {
        read();
    } catch (const InputError& error) {
        for (const Mistake& one : error.mistakes()) lines.push_back(one.line());
    }
    return lines;
}

}  // namespace

TEST_CASE("a scene given as a column, and the reverse, is one mistake with the right command",
          "[scenes][words]") {
    using Catch::Contains;
    const ScratchFolder place("file-kinds");
    const auto scene = place.path / "scene.toml", column = place.path / "column.toml";
    std::ofstream(scene) << "[scene]\nname = \"a\"\n[terrain]\nelevation = \"d.asc\"\n"
                            "[weather]\nfile = \"w.csv\"\n[[observer]]\nname = \"east\"\n";
    std::ofstream(column) << "[site]\nlatitude_deg = 1.0\nlongitude_deg = 2.0\n[material]\n"
                             "name = \"asphalt\"\n[weather]\nfile = \"w.csv\"\n[time]\n"
                             "start = 2026-07-15T00:00:00Z\nend = 2026-07-16T00:00:00Z\n";
    const auto as_column = mistakes([&] { read_column_job(scene); });
    REQUIRE(as_column.size() == 1);
    CHECK_THAT(as_column.front(),
               Contains("is a scene") && Contains("diurna run " + scene.string()));
    const auto as_scene = mistakes([&] { read_scene(column); });
    REQUIRE(as_scene.size() == 1);
    CHECK_THAT(as_scene.front(),
               Contains("is a column file") && Contains("diurna column " + column.string()));
    // Each as what it is: other mistakes, of its own keys.
    for (const std::string& line : mistakes([&] { read_column_job(column); })) {
        CHECK_THAT(line, !Contains("is a scene"));
    }
    for (const std::string& line : mistakes([&] { read_scene(scene); })) {
        CHECK_THAT(line, !Contains("is a column"));
    }
}
