#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "tests/support/canyon.hpp"
#include "thermal/solve/facet_exchange.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;

namespace {

/// Floor 0, walls 1.
FacetOptics optics_of(const testing::LongCanyon& canyon, double floor, double wall) {
    FacetOptics optics;
    for (const int side : canyon.side) optics.albedo.push_back(float(side == 0 ? floor : wall));
    optics.emissivity.assign(canyon.side.size(), 0.0f);
    return optics;
}

/// Straight down on the middle of the floor, from above the walls: a strip along it.
Observer above_floor(const testing::LongCanyon& canyon) {
    Observer eye;
    eye.projection = Projection::orthographic;
    eye.position = {0.0, 0.0, canyon.height + 5.0};
    eye.elevation_deg = -90.0;
    eye.picture_width = 0.96 * canyon.width;
    eye.width = 32;
    eye.height = 32;
    return eye;
}

}  // namespace

// An endless canyon is a plane problem: strips joined by crossed strings (Hottel), solved as one
// linear system of 300 unknowns. White sky, and a beam straight down which the walls take no part
// of. Over the floor, the walls and the lower quarter of the walls.
TEST_CASE("sunlight in a canyon is that of all bounces", "[whole][canyon]") {
    struct Case {
        double floor, wall, shape;
    };
    const Case c = GENERATE(Case{0.95, 0.95, 3.0}, Case{0.85, 0.85, 1.5}, Case{0.2, 0.95, 2.0},
                            Case{0.95, 0.3, 1.0}, Case{0.6, 0.6, 0.5}, Case{0.05, 0.05, 3.0});
    const double width = 10.0, height = c.shape * width, diffuse = 300.0, beam = 700.0;
    const testing::LongCanyon canyon(height, width, 1024, {MaterialId{0}, MaterialId{1}});
    const FacetOptics optics = optics_of(canyon, c.floor, c.wall);
    std::vector<SkyState> sky(2);
    for (SkyState& s : sky) s.to_sun = Eigen::Vector3d::UnitZ();
    sky[0].diffuse_horizontal = diffuse;
    sky[1].direct_normal = beam;
    std::vector<float> incident(2 * canyon.facets.size());
    incident_sunlight({.facets = canyon.facets, .views = canyon.views, .optics = optics},
                      {.sky = {.sky = sky}, .fraction = {}}, incident);
    for (int instant = 0; instant < 2; ++instant) {
        const testing::CanyonLight exact = testing::endless_canyon(
            height, width,
            [&](int side, double open) {
                return instant == 0 ? diffuse * open : side == 0 ? beam : 0.0;
            },
            [&](int side) { return side == 0 ? c.floor : c.wall; }, [](int) { return 0.0; });
        const auto found = [&](std::size_t f) {
            return incident[std::size_t(instant) * canyon.facets.size() + f];
        };
        CAPTURE(c.floor, c.wall, c.shape, instant);
        CHECK(canyon.mean(0, -1.0, 1.0, found) == Approx(exact.mean(0, -1, 1)).epsilon(0.01));
        CHECK(canyon.mean(1, 0.0, height, found) == Approx(exact.mean(1, 0, height)).epsilon(0.01));
        CHECK(canyon.mean(2, 0.0, height, found) == Approx(exact.mean(2, 0, height)).epsilon(0.01));
        CHECK(canyon.mean(1, 0.0, height / 4, found) ==
              Approx(exact.mean(1, 0, height / 4)).epsilon(0.01));
    }
}

// The same canyon in the picture: cold walls and floor, a sky as warm as 300 K above. What is seen
// is ρ × the light that arrives, wavelength by wavelength.
TEST_CASE("a picture of a canyon shows all bounces", "[whole][canyon]") {
    struct Case {
        double floor, wall, wall_at_12_um, shape;
    };
    const Case c = GENERATE(Case{0.95, 0.95, 0.95, 3.0}, Case{0.85, 0.85, 0.85, 1.5},
                            Case{0.3, 0.9, 0.9, 1.0}, Case{0.9, 0.95, 0.3, 2.0});
    const double width = 10.0, height = c.shape * width;
    const testing::LongCanyon canyon(height, width, 1024, {MaterialId{0}, MaterialId{1}});
    std::vector<Material> painted(2);
    painted[0].name = "floor";
    painted[0].reflectance = flat_spectrum(c.floor);
    painted[1].name = "wall";
    painted[1].reflectance = {{8.0, 12.0}, {c.wall, c.wall_at_12_um}};
    const MaterialLibrary materials(std::move(painted));
    const Atmosphere air = Vacuum{.space_temperature = 300.0};
    const std::vector<float> cold(canyon.facets.size(), 20.0f);
    const Observer eye = above_floor(canyon);
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const View view = cast_view(RayScene(canyon.facets), canyon.facets, eye);
    const Frame frame = render(view, eye, {&band, 1},
                               {.facets = canyon.facets,
                                .views = canyon.views,
                                .materials = materials,
                                .atmosphere = air,
                                .temperature = cold});
    const auto exact = [&](double um) {
        return testing::endless_canyon(
                   height, width, [](int, double open) { return open; },
                   [&](int side) {
                       return side == 0 ? c.floor : materials[MaterialId{1}].reflectance.at(um);
                   },
                   [](int) { return 0.0; })
            .mean(0, -1.0, 1.0);
    };
    // Straight between nine wavelengths, which is 2e-4 off at most.
    std::array<double, 9> arrives{};
    for (std::size_t k = 0; k < arrives.size(); ++k) arrives[k] = exact(8.0 + 0.5 * double(k));
    double expected = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double place = 2.0 * (band.node_um[n] - 8.0);
        const auto k = std::min<std::size_t>(7, std::size_t(place));
        expected += band.weight[n] * c.floor * planck(band.node_um[n], 300.0) *
                    std::lerp(arrives[k], arrives[k + 1], place - double(k));
    }
    double seen = 0.0;
    for (const float pixel : frame["radiance.8-12"].pixel) {
        seen += double{pixel} / double(view.pixels());
    }
    CAPTURE(c.floor, c.wall, c.shape, frame.notes.at("bounces.8-12"));
    CHECK(seen == Approx(expected).epsilon(0.01));
}

// Bright walls of 330 K, ε = 0.1, over a black floor which a constant film and a room behind it let
// tell what longwave arrives: L = σ T⁴ + (h + U) (T − T_air). Against strips that send ε σ T⁴, the
// floor's own σ T⁴ among them.
TEST_CASE("longwave in a canyon of bright walls is that of all bounces", "[whole][canyon]") {
    const double shape = GENERATE(1.0, 3.0);
    const double width = 10.0, height = shape * width, air = 285.0, wall = 330.0, shine = 0.1;
    const testing::LongCanyon canyon(height, width, 512, {MaterialId{0}, MaterialId{1}});
    std::vector<Material> all(2);
    all[0].name = "floor";
    all[0].thermal.convection = ConstantFilm{5.0};
    all[0].thermal.layers = {{0.1, 1.0, 2000.0, 900.0}};
    all[0].thermal.bottom = Interior{.air_temperature = air, .film = 10.0};
    all[1].name = "wall";
    all[1].thermal.emissivity = shine;
    all[1].thermal.convection = ConstantFilm{5.0};
    all[1].thermal.layers = {{0.001, 400.0, 2000.0, 900.0}};
    all[1].thermal.bottom = FixedTemperature{wall};
    const MaterialLibrary materials(std::move(all));
    const double sky = stefan_boltzmann * power4(air);
    Weather weather;
    const SolveOptions options{.start = parse_instant("2026-12-21T00:00:00Z"), .step = 3600.0};
    for (const double hour : {0.0, 24.0}) {
        Forcing forcing;
        forcing.air.temperature = air;
        forcing.air.vapour_pressure = 700.0;
        forcing.shortwave_down = 0.0;
        forcing.longwave_down = sky;
        weather.instant.push_back(later(options.start, 3600.0 * hour));
        weather.sample.push_back(forcing);
    }
    const SunExposure shade{.instant = step_instants(options),
                            .fraction = std::vector<float>(25 * canyon.facets.size(), 0.0f)};
    const SolveResult result = solve({.facets = canyon.facets,
                                      .views = canyon.views,
                                      .sun = shade,
                                      .materials = materials,
                                      .weather = weather,
                                      .site = {.latitude_deg = 85.0, .longitude_deg = 7.0}},
                                     options);
    const auto kelvin = [&](std::size_t f) { return double(result.temperature.kelvin[f]); };
    const auto sent = [&](std::size_t f) { return stefan_boltzmann * power4(kelvin(f)); };
    const double floor = canyon.mean(0, -1.0, 1.0, sent);
    const testing::CanyonLight exact = testing::endless_canyon(
        height, width, [&](int, double open) { return sky * open; },
        [&](int side) { return side == 0 ? 0.0 : 1.0 - shine; },
        [&](int side) { return side == 0 ? floor : shine * stefan_boltzmann * power4(wall); });
    const double arrives = floor + 10.0 * (canyon.mean(0, -1.0, 1.0, kelvin) - air);
    CAPTURE(shape, result.report.passes);
    CHECK(result.report.converged);
    CHECK(arrives - sky == Approx(exact.mean(0, -1.0, 1.0) - sky).epsilon(0.01));
}
