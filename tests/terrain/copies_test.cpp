#include "terrain/visibility/copies.hpp"

#include <Eigen/Geometry>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/visibility/ray_bundles.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/two_sides.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

// Against the same scene with every facet built out.

using namespace diurna;

namespace {

constexpr std::size_t ground_side = 24;

/// Level ground of 48 m with a box 4 x 3 x 2 m on it, which stands in two more places, in one
/// turned.
struct Yard {
    FacetSet facets, built_out;
    std::size_t ground = 0;
    Copies copies;
};

void append(FacetSet& to, const FacetSet& more) {
    const auto first = static_cast<std::uint32_t>(to.vertex.size());
    to.vertex.insert(to.vertex.end(), more.vertex.begin(), more.vertex.end());
    for (const auto& [a, b, c] : more.corner) {
        to.corner.push_back({first + a, first + b, first + c});
    }
    to.centroid.insert(to.centroid.end(), more.centroid.begin(), more.centroid.end());
    to.normal.insert(to.normal.end(), more.normal.begin(), more.normal.end());
    to.area.insert(to.area.end(), more.area.begin(), more.area.end());
    to.material.insert(to.material.end(), more.material.begin(), more.material.end());
    to.object.insert(to.object.end(), more.object.begin(), more.object.end());
}

Eigen::Isometry3d moved_by(double east, double north, double up, double turn_deg,
                           const Eigen::Vector3d& about) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(about + Eigen::Vector3d(east, north, up));
    pose.rotate(Eigen::AngleAxisd(turn_deg * 3.141592653589793 / 180.0, Eigen::Vector3d::UnitZ()));
    pose.translate(-about);
    return pose;
}

void append_ground(FacetSet& facets) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    constexpr std::uint32_t n = ground_side;
    for (std::uint32_t row = 0; row <= n; ++row) {
        for (std::uint32_t column = 0; column <= n; ++column) {
            vertex.emplace_back(2.0 * column - 24.0, 2.0 * row - 24.0, 0.0);
            if (row == n || column == n) continue;
            const std::uint32_t at = row * (n + 1) + column;
            triangle.push_back({at, at + 1, at + n + 2});
            triangle.push_back({at, at + n + 2, at + n + 1});
        }
    }
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
}

Yard a_yard(bool with_sheet) {
    Yard yard;
    append_ground(yard.facets);
    yard.ground = yard.facets.size();
    const Eigen::Vector3d at(-6.3, -4.1, 0.0);
    append_facets(yard.facets,
                  box({.base = at, .width = 4.0, .depth = 3.0, .height = 2.0, .largest_edge = 1.0}),
                  ObjectId{1});
    if (with_sheet) {  // over the box, two-sided, of a material of its own
        const std::vector<Eigen::Vector3d> vertex{
            {-8.0, -6.0, 3.0}, {-4.0, -6.0, 3.2}, {-4.0, -2.0, 3.4}, {-8.0, -2.0, 3.1}};
        const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}, {0, 2, 3}};
        const auto first = static_cast<std::uint32_t>(yard.facets.size());
        append_facets(yard.facets, vertex, triangle, std::vector<MaterialId>(2, MaterialId{1}),
                      ObjectId{1});
        append_backs(yard.facets, std::array{first, first + 1},
                     std::array{MaterialId{1}, MaterialId{1}});
    }
    const auto size = static_cast<std::uint32_t>(yard.facets.size() - yard.ground);
    const auto first = static_cast<std::uint32_t>(yard.ground);
    yard.copies = Copies({{first, size, ObjectId{2}, moved_by(12.0, 1.5, 0.0, 0.0, at)},
                          {first, size, ObjectId{3}, moved_by(4.0, 13.0, 0.25, 37.0, at)}});
    yard.built_out = yard.facets;
    for (std::size_t c = 0; c < yard.copies.size(); ++c) {
        // With shared vertices, as its back has them.
        FacetSet placed = in_place(yard.facets, yard.copies[c]);
        for (std::size_t f = 0; f < placed.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                for (std::uint32_t v = 0; v < placed.corner[f][k]; ++v) {
                    if (placed.vertex[v] != placed.vertex[placed.corner[f][k]]) continue;
                    placed.corner[f][k] = v;
                    break;
                }
            }
        }
        append(yard.built_out, placed);
    }
    return yard;
}

/// The facet of the built-out yard for what a ray has met.
std::size_t built_out_place(const Yard& yard, std::uint32_t facet, std::uint32_t copy) {
    if (copy == no_copy) return facet;
    std::size_t place = yard.facets.size() + (facet - yard.copies[copy].first);
    for (std::uint32_t c = 0; c < copy; ++c) place += yard.copies[c].facets;
    return place;
}

std::vector<Ray> rays_about(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> wide(-20.0f, 20.0f), high(0.3f, 9.0f);
    std::normal_distribution<float> normal;
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = {wide(random), wide(random), high(random)};
        ray.direction =
            Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    }
    return rays;
}

}  // namespace

TEST_CASE("rays meet copies where the same facets built out stand", "[terrain][rays][copies]") {
    const Yard yard = a_yard(true);
    const RayScene scene(yard.facets, {}, yard.copies), all(yard.built_out);
    constexpr std::size_t count = 64'000;
    const std::vector<Ray> rays = rays_about(count);
    std::vector<Hit> hit(count), expected(count);
    std::vector<std::uint8_t> blocked(count), expected_blocked(count);
    scene.closest(rays, hit);
    all.closest(rays, expected);
    scene.occluded(rays, blocked);
    all.occluded(rays, expected_blocked);
    RayBundles bundles(scene, count / RayBundles::lanes);
    std::vector<std::uint32_t> by_packet;
    for (std::size_t i = 0; i < count; ++i) {
        bundles.origin_x[i] = rays[i].origin.x(), bundles.direction_x[i] = rays[i].direction.x();
        bundles.origin_y[i] = rays[i].origin.y(), bundles.direction_y[i] = rays[i].direction.y();
        bundles.origin_z[i] = rays[i].origin.z(), bundles.direction_z[i] = rays[i].direction.z();
    }
    bundles.closest(count / RayBundles::lanes);
    for (std::size_t i = 0; i < count; i += 16) {
        RayPacket packet;
        for (std::size_t k = 0; k < 16; ++k) {
            const Ray& ray = rays[i + k];
            packet.origin_x[k] = ray.origin.x(), packet.direction_x[k] = ray.direction.x();
            packet.origin_y[k] = ray.origin.y(), packet.direction_y[k] = ray.direction.y();
            packet.origin_z[k] = ray.origin.z(), packet.direction_z[k] = ray.direction.z();
        }
        std::array<std::uint32_t, 16> met;
        scene.closest(packet, 16, met);
        by_packet.insert(by_packet.end(), met.begin(), met.end());
    }
    std::size_t other = 0, copied = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool none = expected[i].facet == no_facet;
        REQUIRE((blocked[i] == 0) == (hit[i].facet == no_facet));
        if (none || hit[i].facet == no_facet) {
            other += none != (hit[i].facet == no_facet);
            continue;
        }
        const Copies::Place bundle = yard.copies.at(bundles.facet[i]),
                            packet = yard.copies.at(by_packet[i]);
        CHECK(bundle.facet == index(hit[i].facet));
        CHECK(bundle.copy == hit[i].copy);
        CHECK(packet.facet == index(hit[i].facet));
        CHECK(packet.copy == hit[i].copy);
        copied += hit[i].copy != no_copy;
        // At an edge one may meet either facet.
        other += built_out_place(yard, static_cast<std::uint32_t>(index(hit[i].facet)),
                                 hit[i].copy) != index(expected[i].facet);
        worst = std::max(worst, std::abs(double{hit[i].range} - double{expected[i].range}));
        worst = std::max(worst, std::abs(double{bundles.range[i]} - double{expected[i].range}));
    }
    CAPTURE(other, copied, worst);
    CHECK(copied > count / 50);
    CHECK(other <= count / 10'000);
    CHECK(worst < 1e-3);  // 2e-5 of 48 m where Embree's own range is kept
}

TEST_CASE("sheets in copies' places show their backs and dim the beam", "[terrain][rays][copies]") {
    const Yard yard = a_yard(true);
    std::vector<PassedLight> passed(2);
    passed[1] = {.beam = {0.0f, 0.2f, 0.6f}, .heat = 0.4f, .sunlight = 0.4f};
    const RayScene scene(yard.facets, passed, yard.copies), all(yard.built_out, passed);
    const std::vector<Ray> rays = rays_about(20'000);
    std::vector<float> share(rays.size()), expected(rays.size());
    scene.beam(rays, share);
    all.beam(rays, expected);
    std::size_t other = 0, dimmed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        other += std::abs(share[i] - expected[i]) > 1e-4f;
        dimmed += expected[i] > 0.0f && expected[i] < 1.0f;
    }
    CAPTURE(other);
    CHECK(dimmed > 60);
    CHECK(other <= 2);
    std::vector<RayScene::Met> met, as;
    for (std::size_t i = 0; i < 2000; ++i) {
        scene.along(rays[i], true, met);
        all.along(rays[i], true, as);
        REQUIRE(met.size() == as.size());
        for (std::size_t k = 0; k < met.size(); ++k) {
            CHECK(met[k].share == Approx(as[k].share).margin(1e-6));
            if (met[k].number == index(no_facet)) continue;
            const auto [facet, copy] = yard.copies.at(met[k].number);
            CHECK(built_out_place(yard, facet, copy) == as[k].number);
        }
    }
}

TEST_CASE("copies cast shadows and hide the sky as if built out", "[terrain][sun][sky][copies]") {
    const Yard yard = a_yard(false);
    const RayScene scene(yard.facets, {}, yard.copies), all(yard.built_out);
    std::vector<float> lit(yard.facets.size()), expected(yard.built_out.size());
    const Eigen::Vector3d sun = Eigen::Vector3d(0.5, -0.4, 0.45).normalized();
    sun_fraction(yard.facets, scene, sun, lit);
    sun_fraction(yard.built_out, all, sun, expected);
    std::size_t shaded = 0;
    for (std::size_t f = 0; f < yard.facets.size(); ++f) {
        CHECK(lit[f] == Approx(expected[f]).margin(1e-6));
        shaded += f < yard.ground && expected[f] < 1.0f;
    }
    CHECK(shaded > 20);

    FacetViews views = facet_views(yard.facets, scene, {.rays = 256}),
               as = facet_views(yard.built_out, all, {.rays = 256});
    for (std::size_t f = 0; f < yard.facets.size(); ++f) {
        CHECK(views.sky[f] == Approx(as.sky[f]).margin(1.5 / 256));
    }
    // What is seen in either place goes to the facets there.
    make_reciprocal(yard.facets, views);
    CHECK(views.copied.row.empty());
    std::size_t sees_copies = 0;
    for (std::size_t f = 0; f < yard.facets.size(); ++f) {
        double sum = double{views.sky[f]} + views.below[f];
        double of_boxes = 0.0, expected_boxes = 0.0;
        for (auto k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
            sum += views.others.factor[k];
            REQUIRE(views.others.facet[k] < yard.facets.size());
            if (k > views.others.row[f]) CHECK(views.others.facet[k - 1] < views.others.facet[k]);
            if (views.others.facet[k] >= yard.ground) of_boxes += views.others.factor[k];
        }
        CHECK(sum == Approx(1.0).margin(1e-5));
        if (f >= yard.ground) continue;
        for (auto k = as.others.row[f]; k < as.others.row[f + 1]; ++k) {
            if (as.others.facet[k] >= yard.ground) expected_boxes += as.others.factor[k];
        }
        if (expected_boxes > 0.5) continue;  // below a box, which has no floor
        sees_copies += expected_boxes > 0.05;
        // Reciprocity moves what rays of one facet alone have found by its noise.
        CHECK(of_boxes == Approx(expected_boxes).margin(0.03));
    }
    CHECK(sees_copies > 30);
}

TEST_CASE("more copied facets than there are numbers are refused", "[terrain][copies]") {
    const std::vector<Copy> many(3, {.first = 0, .facets = 1u << 30, .object = ObjectId{1}});
    CHECK_THROWS_AS(Copies(many), InputError);
    CHECK(Copies({many.front()}).at(0xFFFFFFFFu).copy == no_copy);
}
