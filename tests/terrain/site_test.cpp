#include "terrain/place/site.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace diurna;

// Published with PROJ's topocentric conversion, identical to the last digit.
TEST_CASE("places near the Alps have the local coordinates PROJ gives",
          "[terrain][site][by_comparison]") {
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

TEST_CASE("far places lie higher above the level surface", "[terrain][site]") {
    // 10 km away the tangent plane is 7.85 m above the sphere.
    CHECK(level_height({6000.0, 8000.0, 0.0}) == Approx(1e8 / (2.0 * 6371230.0)));
    CHECK(level_height({0.0, 0.0, -5.0}) == -5.0);
    const double beyond = std::hypot(6371230.0, 1e5) - 6371230.0;  // a sphere
    CHECK(level_height({1e5, 0.0, 0.0}) == Approx(beyond).margin(0.05));
}

TEST_CASE("the Earth falls away below the horizontal plane", "[terrain][site]") {
    // Drop of a sphere of 6371 km at 50 km: 196.2 m; the ellipsoid's radius differs by 0.5 %.
    const Site site{0.0, 0.0, 0.0};
    const Eigen::Vector3d east = to_local(site, {0.0, 50e3 / 6378137.0 * 180.0 / M_PI, 0.0});
    CHECK(east.z() == Approx(-196.2).epsilon(0.006));
}

TEST_CASE("refraction lifts what is far by an eighth of the Earth's drop", "[terrain][site]") {
    // Elevation seen from sea level over 50 km on a sphere of 6371 km: a peak of 1000 m 0.92084°,
    // 0.95008° with k = 0.13; one of 200 m 0.00435° and 0.03358°.
    struct Case {
        double height, refraction, elevation_deg;
    };
    const auto [height, refraction, elevation_deg] =
        GENERATE(values<Case>({{1000.0, 0.0, 0.92084},
                               {1000.0, 0.13, 0.95008},
                               {200.0, 0.0, 0.00435},
                               {200.0, 0.13, 0.03358}}));
    // At 45° north the ellipsoid is as flat as that sphere to 0.3 %, mean of the azimuths.
    double sum = 0.0;
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 10) {
        const Site site{45.0, 8.0, 0.0, refraction};
        Geodetic far = to_geodetic({45.0, 8.0, 0.0}, 50e3 * direction(azimuth_deg, 0.0));
        far.height = height;
        const Eigen::Vector3d local = to_local(site, far);
        sum += std::atan2(local.z(), local.head<2>().norm()) * 180.0 / M_PI / 36.0;
        const Geodetic back = to_geodetic(site, local);
        CHECK(back.height == Approx(height).margin(1e-5));
    }
    CHECK(sum == Approx(elevation_deg).margin(1e-3));
}

TEST_CASE("a bent line of sight between any two places is straight in the frame",
          "[terrain][site]") {
    // From 30 km west to 20 km east of the site, 10 km north of it, with curvature k/R.
    const double k = 0.13, radius = 6371e3;
    const Site plain{46.0, 8.0, 0.0}, bent{46.0, 8.0, 0.0, k};
    std::vector<Eigen::Vector3d> seen;
    for (const double s : {0.0, 25e3, 50e3}) {
        const Eigen::Vector3d on_ray(s - 30e3, 10e3, 500.0 + 0.01 * s - k * s * s / (2.0 * radius));
        seen.push_back(to_local(bent, to_geodetic(plain, on_ray)));
    }
    CHECK((seen[1] - 0.5 * (seen[0] + seen[2])).norm() < 1e-6);
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
