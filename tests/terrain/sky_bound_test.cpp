#include "terrain/visibility/sky_bound.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "terrain/objects/box.hpp"
#include "terrain/visibility/hemisphere_rays.hpp"
#include "terrain/visibility/lifted_facet.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

// The bound may be loose but never wrong: no ray above it meets anything.

using namespace diurna;

namespace {

constexpr std::size_t patch = 32;

struct Sheet {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;

    void append_to(FacetSet& facets) const {
        append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()),
                      ObjectId{0});
    }
};

template <class Height>
Sheet sheet(int n, double step, const Height& height) {
    Sheet made;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            made.vertex.emplace_back(step * i, step * j, height(step * i, step * j));
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (n + 1) + i);
            const auto b = a + static_cast<std::uint32_t>(n) + 1;
            made.triangle.push_back({a, a + 1, b + 1});
            made.triangle.push_back({a, b + 1, b});
        }
    }
    return made;
}

double hills(double x, double y) {
    return 40.0 * std::sin(0.021 * x) * std::cos(0.013 * y) + 9.0 * std::sin(0.11 * x + 0.07 * y);
}

/// Traces rays just above the bound and anywhere above it; returns the share of patches that have
/// one.
double check_bound(const FacetSet& facets) {
    const SkyBound bound(facets);
    const RayScene scene(facets);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform;
    std::size_t known = 0, blocked_rays = 0, patches = 0;
    for (std::size_t f = 0; f < facets.size(); f += patch, ++patches) {
        const std::size_t end = std::min(facets.size(), f + patch);
        const SkyBound::Sines sines = bound.sines(facets, f, end);
        if (sines == SkyBound::unknown) continue;
        ++known;
        std::vector<Ray> rays;
        for (std::size_t g = f; g < end; ++g) {
            const LiftedFacet from(facets, g);
            for (int k = 0; k < 24; ++k) {
                const double azimuth = 2.0 * M_PI * uniform(random);
                const double east = std::sin(azimuth), north = std::cos(azimuth);
                const double least = sines[compass_octant(float(east), float(north))];
                const double up = k % 2 ? least + 1e-6 : least + (1.0 - least) * uniform(random);
                const double flat = std::sqrt(1.0 - std::min(1.0, up * up));
                rays.push_back({.origin = from.at(uniform(random), uniform(random)),
                                .direction = {float(flat * east), float(flat * north), float(up)}});
            }
        }
        std::vector<std::uint8_t> blocked(rays.size());
        scene.occluded(rays, blocked);
        for (const std::uint8_t b : blocked) blocked_rays += b;
    }
    CHECK(blocked_rays == 0);
    return double(known) / double(patches);
}

}  // namespace

TEST_CASE("nothing is above the bound on hills", "[terrain][sky_bound]") {
    FacetSet facets;
    sheet(90, 5.0, hills).append_to(facets);
    CHECK(check_bound(facets) > 0.5);  // all but the patches at the edge
}

TEST_CASE("on a slope the bound is near its steepness uphill and near the horizontal downhill",
          "[terrain][sky_bound]") {
    FacetSet facets;
    sheet(64, 1.0, [](double, double y) { return 0.3 * y; }).append_to(facets);
    const SkyBound bound(facets);
    std::size_t seen = 0;
    for (std::size_t f = 0; f < facets.size(); f += patch) {
        const auto sines = bound.sines(facets, f, f + patch);
        if (sines == SkyBound::unknown) continue;
        ++seen;
        const double up = sines[compass_octant(0.1f, 1.0f)];
        CHECK(up >= 0.3 / std::hypot(1.0, 0.3));
        // From its lowest corner a patch of 4 m sees the far edge of a cell of 1.4 m that begins
        // three cells away from its highest: 0.3 (1 + 5.4 / 4.2).
        CHECK(up < 0.73 / std::hypot(1.0, 0.73));
        CHECK(sines[compass_octant(-0.1f, -1.0f)] < 0.1);
    }
    CHECK(seen > 20);
}

TEST_CASE("walls, roofs above, steps and holes leave no bound that is wrong",
          "[terrain][sky_bound][stress]") {
    FacetSet facets;
    Sheet ground = sheet(90, 5.0, hills);
    SECTION("a tower") {
        ground.append_to(facets);
        append_facets(facets,
                      box({.base = {220.0, 210.0, hills(220.0, 210.0)},
                           .width = 8.0,
                           .depth = 8.0,
                           .height = 60.0}),
                      ObjectId{1});
    }
    SECTION("a roof over everything, half a metre above the ground") {
        ground.append_to(facets);
        sheet(90, 5.0, [](double x, double y) { return hills(x, y) + 0.5; }).append_to(facets);
    }
    SECTION("a step without a wall") {
        sheet(45, 5.0, hills).append_to(facets);
        Sheet upper = sheet(45, 5.0, [](double x, double y) { return hills(x + 225.0, y) + 30.0; });
        for (auto& v : upper.vertex) v.x() += 225.0;
        upper.append_to(facets);
    }
    SECTION("a hole") {
        std::erase_if(ground.triangle, [&](const auto& t) {
            return (ground.vertex[t[0]] - ground.vertex[45 * 91 + 45]).norm() < 30.0;
        });
        ground.append_to(facets);
    }
    SECTION("slivers across everything") {
        ground.append_to(facets);
        Sheet ribbon;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            ribbon.vertex.emplace_back(0.0, 0.2 * i, 100.0);
            ribbon.vertex.emplace_back(450.0, 449.0 - 0.2 * i, 100.0);
            ribbon.vertex.emplace_back(450.0, 450.0 - 0.2 * i, 101.0);
            ribbon.triangle.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        ribbon.append_to(facets);
    }
    check_bound(facets);
}

TEST_CASE("sky view is the same with exchange and without", "[terrain][visibility][sky]") {
    FacetSet facets;
    sheet(60, 5.0, hills).append_to(facets);
    const RayScene scene(facets);
    const FacetViews both = facet_views(facets, scene, {.rays = 48});
    const FacetViews sky = facet_views(facets, scene, {.rays = 48, .others = false});
    CHECK(both.sky == sky.sky);
    CHECK(both.below == sky.below);
    CHECK(sky.others.facet.empty());
    CHECK(sky.others.row == std::vector<std::uint32_t>(facets.size() + 1, 0));
    // And the same as if every ray were traced.
    const HemisphereRays sampler(48, 1);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        int open = 0, below = 0;
        for (std::size_t p = 0; p < sampler.packets(); ++p) {
            RayPacket rays;
            std::array<std::uint8_t, 16> blocked;
            sampler.fill(facets, f, p, rays);
            scene.occluded(rays, sampler.lanes(p), blocked);
            for (std::size_t k = 0; k < 16; ++k) {
                if (!blocked[k]) ++(rays.direction_z[k] >= 0.0f ? open : below);
            }
        }
        REQUIRE(both.sky[f] == Approx(open / 48.0).margin(1e-6));
        REQUIRE(both.below[f] == Approx(below / 48.0).margin(1e-6));
    }
}
