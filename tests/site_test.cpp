#include "terrain/site.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace diurna;

// Published with PROJ's topocentric conversion, identical to the last digit.
TEST_CASE("places near the Alps have the local coordinates PROJ gives", "[terrain][site]") {
    const Site site{46.5, 8.0, 0.0};
    struct Case {
        Geodetic place;
        Eigen::Vector3d local;
    };
    const auto& [place, local] = GENERATE(values<Case>({
        {{46.9, 8.2, 1500.0}, {15243.103830, 44495.403807, 1326.433490}},
        {{47.35, 8.5, 400.0}, {37780.838572, 94616.017049, -414.447700}},
        {{46.5, 8.0, 4000.0}, {0.0, 0.0, 4000.0}},
    }));
    CHECK((to_local(site, place) - local).norm() < 2e-6);
    const Geodetic back = to_geodetic(site, local);
    CHECK(back.latitude_deg == Approx(place.latitude_deg).margin(2e-11));
    CHECK(back.longitude_deg == Approx(place.longitude_deg).margin(2e-11));
    CHECK(back.height == Approx(place.height).margin(2e-6));
}

TEST_CASE("the Earth falls away below the horizontal plane", "[terrain][site]") {
    // Drop of a sphere of 6371 km at 50 km: 196.2 m; the ellipsoid's radius differs by 0.5 %.
    const Site site{0.0, 0.0, 0.0};
    const Eigen::Vector3d east = to_local(site, {0.0, 50e3 / 6378137.0 * 180.0 / M_PI, 0.0});
    CHECK(east.z() == Approx(-196.2).epsilon(0.006));
}

TEST_CASE("many places at once are the same as one by one", "[terrain][site]") {
    const Site site{-33.0, 179.99, 120.0};
    const std::array<Geodetic, 2> places{{{-33.01, -179.99, 10.0}, {-32.9, 179.9, 900.0}}};
    std::array<Eigen::Vector3d, 2> local;
    to_local(site, places, local);
    for (std::size_t i = 0; i < places.size(); ++i) CHECK(local[i] == to_local(site, places[i]));
    // Across the date line east is still east: 0.02° of longitude, not 359.98°.
    CHECK(local[0].x() == Approx(1870.0).margin(10.0));
}

TEST_CASE("azimuth runs clockwise from north and elevation upward", "[terrain][site]") {
    CHECK((direction(0.0, 0.0) - Eigen::Vector3d::UnitY()).norm() < 1e-15);
    CHECK((direction(90.0, 0.0) - Eigen::Vector3d::UnitX()).norm() < 1e-15);
    CHECK((direction(123.0, 90.0) - Eigen::Vector3d::UnitZ()).norm() < 1e-15);
    CHECK(direction(211.0, 37.0).norm() == Approx(1.0).epsilon(1e-15));
}
