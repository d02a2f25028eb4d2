#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/raster/geotiff.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

// `mesh` and `check` take at most ten times their input and 200 MB, however fine the mesh.

namespace {

struct Ran {
    int code;
    double megabytes;  // most that the program held at a time
};

Ran program(std::vector<std::string> arguments) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        std::vector<char*> argv;
        arguments.insert(arguments.begin(), DIURNA_BINARY);
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        execv(DIURNA_BINARY, argv.data());
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    REQUIRE(wait4(child, &status, 0, &usage) == child);
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), double(usage.ru_maxrss) * 1024e-6};
}

double allowed(double posts, double bytes_a_post) { return 10e-6 * posts * bytes_a_post + 200.0; }

}  // namespace

TEST_CASE("meshes of real relief keep to their memory", "[terrain][memory][samples]") {
    struct Case {
        std::string file;
        std::string tolerance;
        double posts;
    };
    const Case c = GENERATE(values<Case>({{"tuolumne_albers_30m.tif", "1", 1100. * 1100.},
                                          {"tuolumne_albers_30m.tif", "0.3", 1100. * 1100.},
                                          {"bigtujunga.tif", "0", 1197. * 643.},
                                          {"N48W125.hgt.zip", "2", 3601. * 3601.}}));
    const auto file = shared_data("data/dem/" + c.file);
    if (!file) return;
    const Ran ran = program({"mesh", file->string(), "--tolerance-m", c.tolerance});
    CAPTURE(c.file, c.tolerance);
    CHECK(ran.code == 0);
    CHECK(ran.megabytes <= allowed(c.posts, 2.0));  // 16-bit integers
    WARN(c.file << " to " << c.tolerance << " m: " << ran.megabytes << " MB of "
                << allowed(c.posts, 2.0));
}

TEST_CASE("a mesh that would need too much memory is refused", "[terrain][memory][stress]") {
    // A rough surface of 4 million posts: neither network nor grid would fit.
    const ScratchFolder folder("memory");
    diurna::Dem dem;
    dem.source = "rough";
    dem.columns = dem.rows = 2000;
    dem.transform = {420e3, 10.0, 0.0, 5100e3, 0.0, -10.0};
    dem.crs_wkt = "EPSG:32632";
    std::uint32_t random = 1;
    for (int i = 0; i < dem.columns * dem.rows; ++i) {
        random = random * 1664525u + 1013904223u;
        dem.height.push_back(float(random >> 24));
    }
    const auto file = folder.path / "rough.tif";
    diurna::write_geotiff(file, dem, {{"height", dem.height}});
    const Ran ran = program({"mesh", file.string(), "--tolerance-m", "0.1"});
    CHECK(ran.code == 2);
    CHECK(ran.megabytes <= allowed(4e6, 2.0));
}

TEST_CASE("a check of the default scene keeps to its memory", "[scenes][memory]") {
    const Ran ran = program({"check", DIURNA_SOURCE_DIR "/scenes/jacksboro/scene.toml"});
    CHECK(ran.code == 0);
    CHECK(ran.megabytes <= allowed(344. * 403., 2.0));
}
