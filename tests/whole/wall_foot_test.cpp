#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/job/plan/prepared.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/hall.hpp"

// A hall on a plain, where nothing emits or reflects: a surface in the beam is warmer than the air
// by what it absorbs over film and conductance to a room of the air's temperature, whatever stands
// beside it; one in the shadow has the air's.

using namespace diurna;
using namespace diurna::testing::sunlit_hall;

TEST_CASE("a wall in the sun has one temperature from eaves to foot", "[whole][objects]") {
    const double slope = GENERATE(0.0, 0.07);
    CAPTURE(slope);
    const Hall scene = hall(slope);
    const World& world = scene.prepared.world;
    const Instant noon = parse_instant("2026-03-21T11:00:00Z");
    const Eigen::Vector3d to_sun = sun_direction(sun_position(world.site, noon));
    const std::vector<float> kelvin = scene.temperature.interpolate(noon);
    // The plain as the program has it, beside the hall.
    const auto ground = [&](const Eigen::Vector3f& p) {
        double nearest = 1e9, height_there = 0.0;
        for (std::size_t g = 0; g < world.ground_facets; ++g) {
            const Eigen::Vector3f to = p - world.facets.centroid[g];
            const double distance = to.head<2>().norm();
            if (distance >= nearest) continue;
            nearest = distance;
            const Eigen::Vector3f& n = world.facets.normal[g];
            height_there = p.z() - to.dot(n) / n.z();
        }
        return height_there;
    };
    int walls = 0;
    double lowest = 1e9;
    for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
        const double cosine = world.facets.normal[f].cast<double>().dot(to_sun);
        if (world.facets.normal[f].z() > 0.5f || cosine < 0.1) continue;
        ++walls;
        const auto& centre = world.facets.centroid[f];
        lowest = std::min(lowest, centre.z() - ground(centre));
        CAPTURE(centre.transpose());
        CHECK(kelvin[f] == Approx(air + beam * cosine / (film + through_wall)).margin(0.3));
    }
    CHECK(walls > 50);
    CHECK(lowest > 0.0);   // no facet reaches into the ground
    CHECK(lowest < 0.25);  // and some are seen within a quarter of a metre of it
}

TEST_CASE("a hall casts its shadow on a plain of two triangles", "[whole][objects][sun]") {
    const Hall scene = hall(0.0);
    const World& world = scene.prepared.world;
    const Instant noon = parse_instant("2026-03-21T11:00:00Z");
    const Eigen::Vector3d to_sun = sun_direction(sun_position(world.site, noon));
    const std::vector<float> kelvin = scene.temperature.interpolate(noon);
    // Within the shadow of a box lies what some point of its height at most has towards the sun.
    const auto share_shaded = [&](const Eigen::Vector2d& p) {
        for (int k = 0; k <= 200; ++k) {
            const double up = height * k / 200.0;
            const Eigen::Vector2d at = p + up / to_sun.z() * to_sun.head<2>();
            if (at.cwiseAbs().maxCoeff() < 0.5 * size) return true;
        }
        return false;
    };
    double shadow = 0.0, expected = 0.0;
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        const double lit = air + beam * to_sun.z() / (film + through_wall);
        if (world.facets.centroid[f].head<2>().norm() > 30.0f) continue;
        const double share = (lit - kelvin[f]) / (lit - air);
        shadow += share * world.facets.area[f];
        // The same share from points over the triangle.
        const auto& [a, b, c] = world.facets.corner[f];
        const auto& v = world.facets.vertex;
        int inside = 0;
        for (int i = 0; i < 100; ++i) {
            const double s = std::sqrt((i / 10 + 0.5) / 10.0), t = (i % 10 + 0.5) / 10.0;
            const Eigen::Vector3f p =
                float(1.0 - s) * v[a] + float(s * (1.0 - t)) * v[b] + float(s * t) * v[c];
            inside += share_shaded(p.head<2>().cast<double>());
        }
        expected += world.facets.area[f] * inside / 100.0;
        // A corner may reach into the sun between the points.
        const bool whole = inside == 100 && share_shaded(v[a].head<2>().cast<double>()) &&
                           share_shaded(v[b].head<2>().cast<double>()) &&
                           share_shaded(v[c].head<2>().cast<double>());
        if (whole) CHECK(kelvin[f] == Approx(air).margin(0.3));
    }
    // A box's shadow beyond it: the plan pushed along its length.
    const Eigen::Vector2d pushed = height / to_sun.z() * to_sun.head<2>();
    CHECK(expected == Approx(size * pushed.cwiseAbs().sum()).epsilon(0.03));
    CHECK(shadow == Approx(expected).epsilon(0.02));
}
