#include "terrain/visibility/object_boxes.hpp"

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "materials/base/random.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_disc.hpp"

using namespace diurna;

namespace {

/// Uniform in [low, high).
struct Drawn {
    std::uint64_t state = 7;
    float operator()(float low, float high) {
        state = hashed(state);
        return low + (high - low) * float(unit_interval(state));
    }
};

/// Upright triangles of a metre or so over a square of 40 m, six objects of 20 each.
struct Thicket {
    FacetSet facets;

    Thicket() {
        Drawn drawn;
        for (std::uint16_t object = 1; object <= 6; ++object) {
            const float x = drawn(-15.0f, 15.0f), y = drawn(-15.0f, 15.0f);
            std::vector<Eigen::Vector3d> vertex;
            std::vector<std::array<std::uint32_t, 3>> triangle;
            for (std::uint32_t k = 0; k < 20; ++k) {
                for (int corner = 0; corner < 3; ++corner) {
                    vertex.push_back(Eigen::Vector3f(x + drawn(-2.0f, 2.0f), y + drawn(-2.0f, 2.0f),
                                                     drawn(0.0f, 3.0f))
                                         .cast<double>());
                }
                triangle.push_back({3 * k, 3 * k + 1, 3 * k + 2});
            }
            append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()),
                          ObjectId{object});
        }
    }
};

std::vector<std::uint32_t> all_of(const ObjectBoxes& boxes) {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

Eigen::AlignedBox3f spot(Drawn& drawn) {
    const Eigen::Vector3f at(drawn(-20.0f, 20.0f), drawn(-20.0f, 20.0f), 0.0f);
    return {at, at + Eigen::Vector3f(drawn(0.1f, 1.0f), drawn(0.1f, 1.0f), 0.0f)};
}

Eigen::Vector3f within(const Eigen::AlignedBox3f& box, Drawn& drawn) {
    return {drawn(box.min().x(), box.max().x()), drawn(box.min().y(), box.max().y()), 0.0f};
}

bool meets(const RayScene& scene, const Eigen::Vector3f& from, const Eigen::Vector3f& way) {
    const Ray ray{.origin = from, .direction = way};
    std::uint8_t blocked = 0;
    scene.occluded({&ray, 1}, {&blocked, 1});
    return blocked != 0;
}

}  // namespace

TEST_CASE("ground in an object's shadow is never taken for sunlit, most other ground is",
          "[terrain][visibility][sun][object_boxes]") {
    const Thicket thicket;
    const RayScene scene(thicket.facets);
    const ObjectBoxes boxes(thicket.facets, 0);
    const std::vector<std::uint32_t> all = all_of(boxes);
    REQUIRE(boxes.size() == 6);
    Drawn drawn{11};
    int shaded = 0, rejected = 0;
    constexpr int trials = 4000;
    std::vector<std::uint32_t> found;
    for (int i = 0; i < trials; ++i) {
        const Eigen::AlignedBox3f ground = spot(drawn);
        const float elevation = drawn(0.01f, 1.57f), azimuth = drawn(0.0f, 6.28f);
        const Eigen::Vector3f sun(std::cos(elevation) * std::sin(azimuth),
                                  std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
        boxes.shading(ground, sun, all, found);
        const bool may = boxes.may_shade(ground, sun, found);
        rejected += may ? 0 : 1;
        const SunDisc disc(sun.cast<double>());
        const Eigen::Vector3d limb = disc.towards(drawn(0.0f, 1.0f), drawn(0.0f, 1.0f));
        if (!meets(scene, within(ground, drawn), limb.cast<float>())) continue;
        ++shaded;
        CAPTURE(i, elevation, azimuth);
        REQUIRE(may);
    }
    CHECK(shaded > trials / 20);
    CHECK(rejected > trials / 3);
}

TEST_CASE("above the tops of all objects there is open sky",
          "[terrain][visibility][sky][object_boxes]") {
    const Thicket thicket;
    const RayScene scene(thicket.facets);
    const ObjectBoxes boxes(thicket.facets, 0);
    Drawn drawn{23};
    int below = 0, above = 0;
    for (int i = 0; i < 200; ++i) {
        const Eigen::AlignedBox3f ground = spot(drawn);
        const auto [far, near] = boxes.far_and_near(ground);
        OpenAbove open{};
        boxes.raise(ground, far, open);
        boxes.raise(ground, near, open);
        for (int k = 0; k < 100; ++k) {
            const float up = drawn(0.0f, 1.0f), azimuth = drawn(0.0f, 6.28f);
            const float level = std::sqrt(1.0f - up * up);
            const Eigen::Vector3f way(level * std::sin(azimuth), level * std::cos(azimuth), up);
            if (up <= open[compass_sector(way.x(), way.y())] * level) {
                ++below;
                continue;
            }
            ++above;
            CAPTURE(i, k, way.x(), way.y(), way.z());
            REQUIRE_FALSE(meets(scene, within(ground, drawn), way));
        }
    }
    CHECK(above > below);
}

TEST_CASE("sectors of the compass follow each other counterclockwise",
          "[terrain][visibility][object_boxes]") {
    std::size_t last = 0;
    for (int deg = 0; deg < 360; ++deg) {
        const double angle = (deg + 0.5) / 180.0 * std::numbers::pi;
        const std::size_t sector = compass_sector(float(std::cos(angle)), float(std::sin(angle)));
        CHECK((sector == last || sector == last + 1));
        last = sector;
    }
    CHECK(last == compass_sectors - 1);
}
