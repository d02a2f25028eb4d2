#include <catch2/catch.hpp>

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
