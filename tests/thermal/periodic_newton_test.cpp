#include <catch2/catch.hpp>
#include <cmath>

#include "thermal/solve/periodic_newton.hpp"

using namespace diurna;

// A facet that has arrived moves by nothing, and the quotient of moves in Broyden's update is 0 / 0
// for it: a hangar's roof once turned to NaN that way while its neighbours went on.
TEST_CASE("a facet that has arrived stays while others of its block go on", "[thermal][periodic]") {
    const FacetSet facets;
    const FacetViews view;
    const SunExposure sun;
    const MaterialLibrary materials;
    const Weather weather{.instant = {Instant{}}, .sample = {Forcing{}}};
    const SolveInput input{.facets = facets,
                           .views = view,
                           .sun = sun,
                           .materials = materials,
                           .weather = weather,
                           .site = {}};
    const SolveOptions options;
    const SkySeries series(weather, {}, 0.0, {}, options.start, options.start);
    SolveState solve(input, options, series);
    Level level{.stride = 1, .kind = std::vector<Kind>(1)};
    Block& block = solve.block.emplace_back();
    // Two states; the period map keeps half of each, so that I − M is a half.
    const PeriodMap::Factors half(0.5 * Eigen::MatrixXd::Identity(2, 2));
    const Eigen::MatrixXf nothing(0, 2);
    block.period = PeriodMap{half, half, nothing, nothing};
    block.material = 0;
    block.stride = lanes;
    block.facet = {0, 1};
    block.start.assign(2 * lanes, 3.0);
    block.change.assign(2 * lanes, 0.0);
    block.change[1] = block.change[lanes + 1] = 1.0;  // lane 0 has arrived, lane 1 has not

    correct(solve, level);
    CHECK(block.start[0] == 3.0);
    CHECK(block.start[1] == Approx(5.0));
    // Now lane 1 finds that its map keeps three quarters, and so half of what was meant is left.
    block.change[1] = block.change[lanes + 1] = 0.5;
    correct(solve, level);
    CHECK(block.start[0] == 3.0);
    CHECK(block.start[lanes] == 3.0);
    // Broyden: the move of 2 undid 0.5 of 1, so what is left, 0.5, takes another 2.
    CHECK(block.start[1] == Approx(7.0));
    CHECK(block.start[lanes + 1] == Approx(7.0));
    CHECK(std::isfinite(block.largest_move));
}
