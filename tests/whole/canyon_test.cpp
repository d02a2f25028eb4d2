#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/radiation/planck.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "tests/support/canyon.hpp"
#include "thermal/solve/facet_exchange.hpp"

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
                      {.sky = sky, .fraction = {}}, incident);
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
