#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "render/picture/exr.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/scratch_folder.hpp"
#include "thermal/temperature_field.hpp"

// Every sample scene, cut to a few rays, one instant and steps of half an hour, gives the same
// bytes whatever the number of threads, and the results written here: a change of results is
// noticed, and these lines are changed with it. Whole digests are not pinned: the mathematical
// functions of the system and the instructions of the processor decide the last bits.

using namespace diurna;
namespace fs = std::filesystem;

namespace {

struct Results {
    double kelvin = 0.0;    // mean of all facets and instants [K]
    double apparent = 0.0;  // mean apparent temperature of all pixels of all pictures [K]
};

Results results_of(const fs::path& out) {
    Results found;
    const TemperatureField field = load_temperature_field(out / "temperatures.nc");
    for (const float value : field.kelvin) found.kelvin += double(value);
    found.kelvin /= double(field.kelvin.size());
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(out / "frames")) {
        if (entry.path().extension() != ".exr") continue;
        for (const Plane& plane : read_exr(entry.path()).planes) {
            if (plane.name.rfind("apparent_temperature", 0) != 0) continue;
            for (const float value : plane.pixel) found.apparent += double(value);
            count += plane.pixel.size();
        }
    }
    REQUIRE(count > 0);
    found.apparent /= double(count);
    return found;
}

/// The scene on one thread and on three: the same bytes but for the files that tell seconds.
Results same_on_any_threads(const std::string& sample, const std::string& more) {
    const ScratchFolder folder("sample");
    std::map<std::string, std::string> bytes[2];
    for (const int threads : {1, 3}) {
        const fs::path out = folder.path / std::to_string(threads);
        const Ran done = ran(fmt::format(
            "{} run {}/scenes/{}/scene.toml --out {} --fresh --progress none --threads {} --set "
            "scene.check_points=0 --set scene.sky_rays=16 --set scene.object_sky_rays=16 --set "
            "time.step_s=1800 --set tolerance_K=0 {} 2>&1",
            DIURNA_BINARY, DIURNA_SOURCE_DIR, sample, out.string(), threads, more));
        CAPTURE(done.out);
        REQUIRE(done.code == 0);
        bytes[threads / 3] = contents(out);
        for (const char* timed : {"report.html", "manifest.json"}) bytes[threads / 3].erase(timed);
    }
    CHECK(bytes[0].size() > 5);
    CHECK(bytes[0] == bytes[1]);
    return results_of(folder.path / "1");
}

void check_sample(const std::string& sample, const std::string& more, Results pinned) {
    const Results now = same_on_any_threads(sample, more);
    CAPTURE(sample, fmt::format("{:.4f} K, {:.4f} K", now.kelvin, now.apparent));
    CHECK(std::abs(now.kelvin - pinned.kelvin) < 0.002);
    CHECK(std::abs(now.apparent - pinned.apparent) < 0.005);
}

}  // namespace

TEST_CASE("the crossover sample has the same bytes on any threads and the pinned results",
          "[whole][samples]") {
    check_sample("crossover", "--only frames=12:00..12:00", {297.8540, 305.8442});
}

TEST_CASE("the camouflage sample has the same bytes on any threads and the pinned results",
          "[whole][samples]") {
    check_sample("camouflage", "--only frames=12:00..12:00", {308.2705, 682.0156});
}

TEST_CASE("the default scene has the same bytes on any threads and the pinned results",
          "[whole][samples][long]") {
    check_sample("jacksboro",
                 "--only frames=12:00..12:00 --only observer=east --set terrain.tolerance_m=40",
                 {301.0134, 301.1695});
}

TEST_CASE("the approach sample has the same bytes on any threads and the pinned results",
          "[whole][samples][long]") {
    check_sample("approach", "--only observer=apron --set terrain.tolerance_m=40",
                 {302.7915, 308.0952});
}

TEST_CASE("the instruments sample has the same bytes on any threads and the pinned results",
          "[whole][samples][long]") {
    check_sample("instruments", "--only frames=14:00..14:00 --set terrain.tolerance_m=40",
                 {301.0134, 695.4657});
}
