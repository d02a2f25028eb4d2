#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

// The second sample scene: four July days as they were measured, made by its own script. The
// stubble against the site's radiometer (NOAA/ARL, Bondville 1998), half-hourly: 1.1 K rms, bias
// +0.4; over the half year the point tool has 1.6 K (README.md).
TEST_CASE("the scene of measured days runs, and its stubble is as warm as measured",
          "[scenes][weather][measured][by_history]") {
    const auto file = shared_data("data/thermal/bondville_1998/jan-jul.dat");
    if (!file) return;
    const ScratchFolder folder("bondville");
    std::filesystem::copy(DIURNA_SOURCE_DIR "/scenes/bondville", folder.path / "bondville");
    std::filesystem::create_directory(folder.path / "jacksboro");
    std::filesystem::copy(DIURNA_SOURCE_DIR "/scenes/jacksboro/truck.obj",
                          folder.path / "jacksboro");
    const std::filesystem::path here = folder.path / "bondville";
    const std::string command = fmt::format("'{}' '{}' > '{}'", (here / "make_weather.sh").string(),
                                            file->string(), (here / "weather.csv").string());
    REQUIRE(std::system(command.c_str()) == 0);
    const Prepared prepared = prepare(read_scene(
        here / "scene.toml",
        {"time.frames=[\"00:00-24:00 every 30 min\"]", "output.fluxes=false", "output.state=false"},
        true));  // its truck is of another folder
    CHECK(prepared.plan.frames.size() == 4 * 48 + 1);
    Progress progress(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), progress);
    CAPTURE(result.start);
    CHECK(result.report.converged);
    CHECK(result.start.find("3 days of earlier weather") != std::string::npos);

    const FacetSet& facets = prepared.world.surfaces();
    const MaterialId stubble = prepared.scene.materials.find("crop_stubble");
    std::size_t open = facets.size();
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.material[f] == stubble && facets.centroid[f].head<2>().norm() > 300.0f) open = f;
    }
    REQUIRE(open < facets.size());
    const measured::Series at_site = measured::bondville_1998(file->parent_path());
    double square = 0.0, bias = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < at_site.when.size(); ++i) {
        const Instant when = at_site.when[i];
        if (when < prepared.scene.time.start || when > prepared.scene.time.end()) continue;
        const double off = double(result.temperature.interpolate(when)[open]) - at_site.skin[i];
        square += off * off;
        bias += off;
        ++count;
    }
    REQUIRE(count > 180);
    CAPTURE(bias / count);
    CHECK(std::sqrt(square / count) < 1.5);
}
