#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "terrain/place/sun.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/bowl.hpp"

// The shadow in a bowl without air or conduction is warmed by its sunlit rest alone. In a spherical
// cap every part sees every other as its share of the sphere, so that σT⁴ = F sin e · f (1 − A) /
// (1 − A f) · (1 + A (1 − f) / ε), f = d² / (D²/4 + d²) (Ingersoll et al. 1992), the same
// everywhere in the shadow. It tests the exchange: light and heat are passed on along its rows.

using namespace diurna;

namespace {

/// Of depth/diameter q and a rim of radius 1.
FacetSet bowl(double q, int rings, int sectors) {
    const double radius = (1.0 + 4.0 * q * q) / (4.0 * q);
    return spherical_bowl(radius, std::asin(1.0 / radius), rings, sectors);
}

/// x = source + share · (what the others send), by passing it on until nothing changes.
std::vector<double> passed_on(const ViewFactors& exchange, const std::vector<double>& source,
                              double share) {
    std::vector<double> x = source;
    for (int pass = 0; pass < 60; ++pass) {
        std::vector<double> next = source;
        for (std::size_t f = 0; f < x.size(); ++f) {
            double met = 0.0;
            for (auto k = exchange.row[f]; k < exchange.row[f + 1]; ++k) {
                met += double{exchange.factor[k]} * x[exchange.facet[k]];
            }
            next[f] += share * met;
        }
        x = std::move(next);
    }
    return x;
}

}  // namespace

TEST_CASE("shadow in an airless bowl has its exact temperature",
          "[terrain][exchange][bowl][by_comparison]") {
    struct Case {
        double sun, elevation_deg, albedo, emissivity, q, temperature;
    };
    const auto [sun, elevation_deg, albedo, emissivity, q, temperature] = GENERATE(values<Case>(
        {{1361, 10, 0.12, 0.95, 0.2, 154.54318}, {1000, 20, 0.2, 0.98, 0.2, 168.434401}}));
    const FacetSet facets = bowl(q, 32, 96);
    const RayScene scene(facets);
    FacetViews view = facet_views(facets, scene, {.rays = 1024});
    const Eigen::Vector3d to_sun = direction(70.0, elevation_deg);
    std::vector<float> lit(facets.size());
    sun_fraction(facets, scene, to_sun, lit, {.samples = 16});
    make_reciprocal(facets, view, {.cut_off = 0.0});

    const std::size_t n = facets.size();
    std::vector<double> reflected(n), emitted(n);
    for (std::size_t f = 0; f < n; ++f) {
        const double incidence = facets.normal[f].cast<double>().dot(to_sun);
        reflected[f] = albedo * sun * lit[f] * std::max(0.0, incidence);
    }
    // Radiosity of sunlight; what is not sent back is taken in and sent out as heat: in equilibrium
    // a facet sends out in all what it takes in, absorbed sun and heat of the others alike.
    const std::vector<double> light = passed_on(view.others, reflected, albedo);
    for (std::size_t f = 0; f < n; ++f) emitted[f] = light[f] / albedo * (1.0 - albedo);
    const std::vector<double> heat = passed_on(view.others, emitted, 1.0);

    double sum = 0.0, area = 0.0, squares = 0.0;
    for (std::size_t f = 0; f < n; ++f) {
        if (lit[f] > 0.0f) continue;
        // ε σT⁴ = absorbed sun + ε · heat met, and heat sent out = absorbed sun + heat met.
        const double met = heat[f] - emitted[f];
        const double t = std::pow((emitted[f] / emissivity + met) / 5.670374419e-8, 0.25);
        sum += t * facets.area[f];
        squares += (t - temperature) * (t - temperature) * facets.area[f];
        area += facets.area[f];
    }
    REQUIRE(area > 0.0);
    const double mean = sum / area, rms = std::sqrt(squares / area);
    CAPTURE(q, elevation_deg, mean, rms);
    CHECK(mean == Approx(temperature).margin(0.1));
    CHECK(rms < 4.0);  // the rays' noise; 7.5 K at 256 rays on twice as many facets
}
