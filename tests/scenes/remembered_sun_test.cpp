#include "scenes/job/run/remembered_sun.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/column/step_response.hpp"

using namespace diurna;

namespace {

/// The hall of the small scene on level concrete of fine facets.
std::string yard() {
    return with(small_scene(), R"([[building]])", R"([[ground]]
name = "yard"
material = "concrete"
rectangle_m = [53.0, -88.4, 120.0, 120.0, 0.0]
largest_edge_m = 6.0
[[building]])");
}

}  // namespace

// The expected share is the same convolution, minute by minute over four hours, of the flux onto
// level ground with concrete's step response, and with rays of its own.
TEST_CASE("a surface remembers the sun as its step response does",
          "[scenes][remembered_sun][by_variation]") {
    const ScratchFolder folder("remembered_sun");
    write_text(folder.path / "scene.toml", yard());
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml", {}, true));
    const Stages stages(prepared);
    const SceneStage stage = stages.at(0);
    const World& world = prepared.world;
    const Instant now = later(prepared.scene.time.start, GENERATE(10.0, 13.0, 17.0) * 3600.0);
    std::vector<SurfaceId> wanted;
    for (std::uint32_t f = 0; f < world.facets.size(); ++f) {
        const auto& name = prepared.scene.materials[world.facets.material[f]].name;
        if (f < world.ground_facets && name == "concrete") wanted.push_back(SurfaceId{f});
    }
    const std::vector<float> present =
        sun_on_surfaces(prepared, sun_over(prepared, now), 4, wanted);
    const RememberedSun found = remembered_sun(prepared, stage.views, present, wanted, now);
    REQUIRE(!found.empty());

    constexpr std::size_t minutes = 240;
    std::vector<double> ends;
    for (std::size_t k = 1; k <= minutes; ++k) ends.push_back(60.0 * double(k));
    const ThermalSurface& concrete =
        prepared.scene.materials[world.facets.material[std::size_t(wanted.front())]].thermal;
    const Forcing air = prepared.weather.at(now);
    const double film = 5.7 + 3.8 * air.wind_speed +
                        4.0 * concrete.emissivity * 5.670374e-8 * std::pow(air.air.temperature, 3);
    const std::vector<double> warm = step_response(concrete, film, ends);
    std::vector<std::uint32_t> chosen;
    for (const SurfaceId f : wanted) {
        const auto n = static_cast<std::uint32_t>(f);
        if (found.past.of_facet[n] != PastSun::at_once) chosen.push_back(n);
    }
    REQUIRE(chosen.size() > 100);
    std::vector<double> expected(world.facets.size(), 0.0);
    std::vector<float> share(world.facets.size(), 0.0f);
    double all = 0.0;
    for (std::size_t k = 0; k < minutes; ++k) {
        const SunPosition sun = sun_over(prepared, later(now, -60.0 * (double(k) + 0.5)));
        const double sine = std::sin(sun.elevation_deg * 3.14159265358979 / 180.0);
        if (sine <= 0.0) break;
        const double weight =
            (warm[k] - (k > 0 ? warm[k - 1] : 0.0)) * sine * std::exp(-0.25 / std::max(0.05, sine));
        sun_fraction(world.facets, prepared.rays, sun_direction(sun), chosen, share,
                     {.samples = 4, .seed = 3});
        for (const std::uint32_t f : chosen) expected[f] += weight * double{share[f]};
        all += weight;
    }
    double squares = 0.0, of_present = 0.0;
    for (const std::uint32_t f : chosen) {
        squares += std::pow(double{found.past.share[f]} - expected[f] / all, 2);
        of_present += std::pow(double{present[f]} - expected[f] / all, 2);
    }
    const double rms = std::sqrt(squares / double(chosen.size()));
    const double present_rms = std::sqrt(of_present / double(chosen.size()));
    CAPTURE(rms, present_rms, chosen.size());
    CHECK(rms < 0.07);  // from five moments for four hours
    CHECK(rms < 0.5 * present_rms);
}
