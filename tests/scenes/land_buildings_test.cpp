#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/world/land.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/built_land.hpp"
#include "tests/support/passed_over.hpp"

// Buildings of scenes and of files of shapes, on the ground.

using namespace diurna;
using namespace diurna::testing::built_land;

TEST_CASE("there is no ground under a building and its neighbours keep their exchange",
          "[scenes][land][exchange]") {
    const Built b = built(small_scene());
    double hangar = 0.0, whole = 0.0;
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
        const double plan = double{b.world.facets.area[f]} * b.world.facets.normal[f].z();
        whole += plan;
        if (f >= b.world.ground_facets) {
            hangar += plan;
            continue;
        }
        // Within 60 × 40 m about (53, −88.4) with its front towards 45°.
        const Eigen::Vector2d to =
            b.world.facets.centroid[f].head<2>().cast<double>() - Eigen::Vector2d(53.0, -88.4);
        const double ahead = (to.x() + to.y()) / std::sqrt(2.0);
        const double right = (to.x() - to.y()) / std::sqrt(2.0);
        CHECK_FALSE((std::abs(ahead) < 19.9 && std::abs(right) < 29.9));
    }
    for (const auto& v : b.world.facets.vertex) {
        low = low.cwiseMin(v.head<2>().cast<double>());
        high = high.cwiseMax(v.head<2>().cast<double>());
    }
    CHECK(hangar == Approx(60.0 * 40.0).epsilon(1e-3));
    CHECK(whole == Approx((high - low).prod()).epsilon(5e-3));  // no gap, nothing twice

    const RayScene rays(b.world.facets);
    FacetViews view = facet_views(b.world.facets, rays, {.rays = 64});
    const std::vector<float> before = view.below;
    make_reciprocal(b.world.facets, view);
    double worst = 0.0;
    for (std::size_t f = 0; f < b.world.ground_facets; ++f) {
        worst = std::max(worst, double{view.below[f]} - before[f]);
    }
    CAPTURE(worst);
    CHECK(worst < 0.35);  // ground under the hangar lost up to 0.94
}

TEST_CASE("what is skipped in a file of buildings is reported", "[scenes][land][buildings]") {
    const auto feature = [](const char* height, double east, const std::string& ring = "") {
        const auto corner = [&](double x, double y) {
            return fmt::format("[{:.6f},{:.6f}]", -84.2033 + east + x, 36.3200 + y);
        };
        const std::string square = corner(0.0, 0.0) + "," + corner(2e-4, 0.0) + "," +
                                   corner(2e-4, 2e-4) + "," + corner(0.0, 2e-4);
        return fmt::format(
            R"({{"type":"Feature","properties":{{"h":{}}},"geometry":{{"type":"Polygon",)"
            R"("coordinates":[[{}]]}}}})",
            height, ring.empty() ? square : ring);
    };
    const auto build = [&](const std::string& features) {
        write_text(scratch.path / "houses.geojson",
                   R"({"type":"FeatureCollection","features":[)" + features + "]}");
        return built(small_scene() +
                     "[[shapes]]\nfile = \"houses.geojson\"\nheight_field = \"h\"\n"
                     "wall = \"concrete_wall\"\nroof = \"painted_steel\"\n");
    };
    const std::vector<std::string> notes =
        build(feature("6", 0.002) + "," + feature("-3", 0.004) + "," + feature("null", 0.005) +
              "," + feature("5", 3.0))
            .world.notes;
    REQUIRE(notes.size() == 2);
    CHECK_THAT(notes[0], Catch::EndsWith("houses.geojson: 2 buildings without a height above 0 m "
                                         "left out; the first is feature 2"));
    CHECK_THAT(notes[1], Catch::EndsWith("1 building outside the elevation data or on void posts "
                                         "left out; the first is feature 4"));
    const std::string crossed =
        "[-84.200,36.320],[-84.199,36.321],[-84.199,36.320],[-84.200,36.321]";
    CHECK_THROWS_WITH(build(feature("6", 0.002) + "," + feature("6", 0.0, crossed)),
                      Catch::Contains("houses.geojson: feature 2: its plan intersects itself"));
}

namespace {

/// A rectangle about the site's neighbourhood [deg east and north of its south-west corner],
/// closed.
std::string rectangle(double west, double south, double east, double north) {
    std::string ring;
    for (const auto& [x, y] :
         {std::pair{west, south}, {east, south}, {east, north}, {west, north}, {west, south}}) {
        ring +=
            fmt::format("{}[{:.6f},{:.6f}]", ring.empty() ? "" : ",", -84.2033 + x, 36.3200 + y);
    }
    return "[" + ring + "]";
}

std::string block(const std::string& rings, const char* height) {
    return fmt::format(R"({{"type":"Feature","properties":{{"h":{}}},"geometry":)"
                       R"({{"type":"Polygon","coordinates":[{}]}}}})",
                       height, rings);
}

Built with_blocks(const std::string& features) {
    write_text(scratch.path / "blocks.geojson",
               R"({"type":"FeatureCollection","features":[)" + features + "]}");
    return built(small_scene() +
                 "[[shapes]]\nfile = \"blocks.geojson\"\nheight_field = \"h\"\n"
                 "wall = \"concrete_wall\"\nroof = \"painted_steel\"\n");
}

/// Of the buildings of shapes, which come last [m²].
std::map<std::string, double> block_areas(const Built& b) {
    std::map<std::string, double> area;
    for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
        if (std::size_t(b.world.facets.object[f]) + 1 != b.world.objects.size()) continue;
        const double up = b.world.facets.normal[f].z();
        area[up > 0.9 ? "roof" : "wall"] += double{b.world.facets.area[f]};
    }
    return area;
}

}  // namespace

TEST_CASE("a courtyard of a file of buildings is ground between walls",
          "[scenes][land][buildings]") {
    const std::string outer = rectangle(0.0040, 0.0020, 0.0050, 0.0030),
                      court = rectangle(0.0043, 0.0023, 0.0047, 0.0027),
                      shed = rectangle(0.0044, 0.0024, 0.0046, 0.0026);
    const Built solid = with_blocks(block(outer, "6")), none = built(small_scene());
    const Built open = with_blocks(block(outer + "," + court, "6"));
    const auto of_solid = block_areas(solid), of_open = block_areas(open);
    CHECK(of_open.at("roof") == Approx(0.84 * of_solid.at("roof")).epsilon(1e-4));
    CHECK(of_open.at("wall") > 1.3 * of_solid.at("wall"));
    const auto ground = [](const Built& b) {
        double sum = 0.0;
        for (std::size_t f = 0; f < b.world.ground_facets; ++f) {
            sum += double{b.world.facets.area[f]} * b.world.facets.normal[f].z();
        }
        return sum;
    };
    const double plan = of_solid.at("roof");
    CHECK(ground(none) - ground(solid) == Approx(plan).epsilon(5e-3));
    CHECK(ground(none) - ground(open) == Approx(0.84 * plan).epsilon(5e-3));
    // A shed in the courtyard stands on its ground, whichever comes first in the file.
    for (const bool first : {false, true}) {
        const std::string both = first ? block(shed, "3") + "," + block(outer + "," + court, "6")
                                       : block(outer + "," + court, "6") + "," + block(shed, "3");
        const Built with_shed = with_blocks(both);
        CHECK(ground(none) - ground(with_shed) == Approx(0.88 * plan).epsilon(5e-3));
        CHECK(block_areas(with_shed).at("roof") == Approx(0.88 * plan).epsilon(1e-4));
    }
}

TEST_CASE("a building that a file has twice is built once", "[scenes][land][buildings]") {
    const std::string ring = rectangle(0.0040, 0.0020, 0.0050, 0.0030);
    const Built once = with_blocks(block(ring, "6"));
    const Built twice = with_blocks(block(ring, "4") + "," + block(ring, "6"));
    CHECK(block_areas(twice).at("roof") == Approx(block_areas(once).at("roof")));
    CHECK(block_areas(twice).at("wall") == Approx(block_areas(once).at("wall")));
    REQUIRE(twice.world.notes.size() == 1);
    CHECK_THAT(twice.world.notes[0], Catch::Contains("feature 1"));
}

TEST_CASE("a field that counts storeys is no height", "[scenes][land][buildings]") {
    write_text(scratch.path / "levels.geojson",
               R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)"
               R"({"building:levels":"3"},"geometry":{"type":"Polygon","coordinates":[)" +
                   rectangle(0.0040, 0.0020, 0.0050, 0.0030) + "]}}]}");
    const std::string table =
        small_scene() +
        "[[shapes]]\nfile = \"levels.geojson\"\nheight_field = \"building:levels\"\n"
        "wall = \"concrete_wall\"\n";
    CHECK_THROWS_WITH(scene_of(table), Catch::Contains("level_height_m"));
    const Built b = built(table + "level_height_m = 3.5\n");
    float top = -1e9f, bottom = 1e9f;
    for (std::size_t f = b.world.ground_facets; f < b.world.facets.size(); ++f) {
        if (std::size_t(b.world.facets.object[f]) + 1 != b.world.objects.size()) continue;
        for (const std::uint32_t v : b.world.facets.corner[f]) {
            top = std::max(top, b.world.facets.vertex[v].z());
            bottom = std::min(bottom, b.world.facets.vertex[v].z());
        }
    }
    CHECK(top - bottom > 10.4f);  // 10.5 m, more where the ground slopes
    CHECK(top - bottom < 14.0f);
}
