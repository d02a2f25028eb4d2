#include "terrain/visibility/sky_basis.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "terrain/place/site.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

// Expected: integrals over the sky in closed form, or summed over directions one by one.

using namespace diurna;
using std::numbers::pi;

namespace {

/// A plane tilted towards an azimuth.
Eigen::Vector3f plane(double tilt_deg, double azimuth_deg) {
    return direction(azimuth_deg, 90.0 - tilt_deg).cast<float>();
}
double along_z(double tilt_deg) {  // 1/π ∫ z cosθ dω, two clipped cosines (Lambert's sphere)
    const double b = tilt_deg * pi / 180.0;
    return 2.0 / (3.0 * pi) * (std::sin(b) + (pi - b) * std::cos(b));
}

/// 1/π ∫ f cosθ dω over the upper hemisphere, rings even in √z.
double sum_over_sky(const Eigen::Vector3d& normal,
                    const std::function<double(const Eigen::Vector3d&)>& f) {
    constexpr int rings = 600, sectors = 720;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double t = (i + 0.5) / rings, z = t * t, r = std::sqrt(1.0 - z * z);
        for (int j = 0; j < sectors; ++j) {
            const double a = 2.0 * pi * (j + 0.5) / sectors;
            const Eigen::Vector3d way(r * std::cos(a), r * std::sin(a), z);
            const double cosine = normal.dot(way);
            if (cosine > 0.0) sum += f(way) * cosine * 2.0 * t;
        }
    }
    return sum * 2.0 / (double(rings) * sectors);
}

/// A long street, walls as high as it is wide, that runs towards an azimuth; and two small plates
/// in its middle, on the ground and on the wall at half its height.
struct Street {
    FacetSet facets;
    Eigen::Vector3f across;  // out of the wall with the plate
    std::size_t floor = 0, wall = 0;

    explicit Street(double azimuth_deg) {
        const Eigen::Vector3d along = direction(azimuth_deg, 0.0), up = Eigen::Vector3d::UnitZ(),
                              over = along.cross(up);
        across = -over.cast<float>();
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        const auto quad = [&](Eigen::Vector3d from, Eigen::Vector3d u, Eigen::Vector3d v) {
            const auto n = std::uint32_t(vertex.size());
            for (const auto& p : {from, Eigen::Vector3d(from + u), Eigen::Vector3d(from + u + v),
                                  Eigen::Vector3d(from + v)}) {
                vertex.push_back(p);
            }
            triangle.push_back({n, n + 1, n + 2});
            triangle.push_back({n, n + 2, n + 3});
        };
        constexpr double far = 20e3;
        quad(5.0 * over + far * along, -2.0 * far * along, 10.0 * up);
        quad(-5.0 * over - far * along, 2.0 * far * along, 10.0 * up);
        quad(-0.01 * over - 0.01 * along, 0.02 * over, 0.02 * along);
        quad(4.99 * over + 0.01 * along + 5.0 * up, -0.02 * along, 0.02 * up);
        append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()),
                      ObjectId{0});
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (facets.area[f] > 1.0f) continue;
            (facets.normal[f].z() > 0.5f ? floor : wall) = f;
        }
    }
};

}  // namespace

TEST_CASE("a plane takes the whole sky's functions as their integrals say",
          "[terrain][visibility][sky]") {
    const double tilt = GENERATE(0.0, 20.0, 45.0, 90.0, 135.0, 180.0);
    const double azimuth = GENERATE(0.0, 77.0, 200.0);
    CAPTURE(tilt, azimuth);
    const SkyVector sky = open_plane(plane(tilt, azimuth));
    const double b = tilt * pi / 180.0;
    CHECK(double{sky[0]} == Approx(0.5 * (1.0 + std::cos(b))).margin(1e-6));
    CHECK(double{sky[1]} == Approx(along_z(tilt)).margin(2e-5));
    // A sky of L0 (1 + 2 cos z), Moon and Spencer's overcast, on a wall: ½ + 2 · 2/(3π).
    if (tilt == 90.0) {
        CHECK(double{sky[0]} + 2.0 * double{sky[1]} == Approx(0.5 + 4.0 / (3.0 * pi)).margin(2e-5));
        CHECK(double{sky[2]} == Approx(0.125).margin(2e-5));
        CHECK(double{sky[3]} == Approx(0.25 + 0.5 * std::log(2.0)).margin(2e-5));
        const Eigen::Vector3d towards = direction(azimuth, 0.0);
        CHECK(double{sky[4]} == Approx(towards.x() / 3.0).margin(2e-5));
        CHECK(double{sky[5]} == Approx(towards.y() / 3.0).margin(2e-5));
    }
    if (tilt == 0.0) {
        CHECK(double{sky[2]} == Approx(0.5).margin(2e-5));
        CHECK(double{sky[3]} == Approx(0.5).margin(2e-5));
        for (std::size_t k = 4; k < sky_functions; ++k)
            CHECK(double{sky[k]} == Approx(0.0).margin(1e-6));
    }
}

TEST_CASE("shares of all functions are sums over directions", "[terrain][visibility][sky]") {
    const double tilt = GENERATE(10.0, 63.0, 90.0, 140.0);
    const Eigen::Vector3f normal = plane(tilt, 217.0);
    const SkyVector sky = open_plane(normal);
    const EvenSkyVector even = even_part(sky, direction(137.0, 0.0).head<2>().cast<float>());
    const Eigen::Vector3d towards = direction(137.0, 0.0), left(-towards.y(), towards.x(), 0.0);
    for (std::size_t k = 0; k < sky_functions; ++k) {
        CAPTURE(tilt, k);
        CHECK(double{sky[k]} == Approx(sum_over_sky(normal.cast<double>(), [&](const auto& way) {
                                    return double{sky_functions_at(way.template cast<float>())[k]};
                                })).margin(1e-4));
    }
    for (std::size_t k = 0; k < even_sky_functions; ++k) {
        CHECK(double{even[k]} ==
              Approx(sum_over_sky(normal.cast<double>(), [&](const auto& way) {
                  const Eigen::Vector3d turned(way.dot(towards), way.dot(left), way.z());
                  return double{sky_functions_at(turned.cast<float>())[even_sky_function[k]]};
              })).margin(1e-4));
    }
}

TEST_CASE("behind a ring of one height the sky is a cap", "[terrain][visibility][sky]") {
    // Level, open down to a zenith angle of sine s: V = s², ∫ z = ⅔ (1 − c³), −ln z: ½ s² + c² ln
    // c.
    const double c = GENERATE(0.9, 0.5, 0.1), s2 = 1.0 - c * c;
    const SkyVector cap = plane_behind_ring(Eigen::Vector3f::UnitZ(), s2);
    CHECK(double{cap[0]} == Approx(s2));
    CHECK(double{cap[1]} == Approx(2.0 / 3.0 * (1.0 - c * c * c)).margin(2e-4));
    CHECK(double{cap[2]} == Approx(0.5 * (1.0 - c * c * c * c)).margin(2e-4));
    CHECK(double{cap[3]} == Approx(0.5 * s2 + c * c * std::log(c)).margin(2e-4));
}

TEST_CASE("rays find which part of the sky a street leaves", "[terrain][visibility][sky]") {
    const double azimuth = GENERATE(0.0, 33.0, 90.0);
    const Street street(azimuth);
    const FacetViews views =
        facet_views(street.facets, RayScene(street.facets), {.rays = 16384, .others = false});
    CAPTURE(azimuth);
    // With α the angle from the zenith across the street and ψ that along it, z = cosψ cosα and
    // dω = cosψ dψ dα; on the ground sin α0 = 1/√5, on the wall cos α1 = 1/√5.
    const double s = 1.0 / std::sqrt(5.0), c = 2.0 / std::sqrt(5.0), a = std::asin(s);
    const Eigen::Vector2f x = street.across.head<2>();
    const EvenSkyVector floor = even_part(sky_of(views, street.facets, street.floor), x);
    CHECK(double{floor[0]} == Approx(s).margin(2e-3));
    CHECK(double{floor[1]} == Approx(4.0 / (3.0 * pi) * (a + s * c)).margin(2e-3));
    CHECK(double{floor[2]} == Approx(0.75 * (s - s * s * s / 3.0)).margin(2e-3));
    CHECK(double{floor[4]} == Approx(0.0).margin(2e-3));
    CHECK(double{floor[7]} == Approx(0.25 * (s * s * s - s)).margin(2e-3));  // x² − y²
    const EvenSkyVector wall = even_part(sky_of(views, street.facets, street.wall), x);
    CHECK(double{wall[0]} == Approx(0.5 * (1.0 - s)).margin(2e-3));
    CHECK(double{wall[1]} == Approx(2.0 / (3.0 * pi) * c * c).margin(2e-3));
    CHECK(double{wall[4]} == Approx(2.0 / (3.0 * pi) * (std::acos(s) - s * c)).margin(2e-3));
}

TEST_CASE("level ground has its shares to the last digit, and few rays do for slopes",
          "[terrain][visibility][sky]") {
    // Nothing hides the sky: what rays leave to chance is not asked of them.
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                                 {5, 0, 0}, {5, 1, 0}, {5, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}, {3, 4, 5}};
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(2), ObjectId{0});
    const FacetViews views = facet_views(facets, RayScene(facets), {.rays = 16});
    for (std::size_t f = 0; f < 2; ++f) {
        const SkyVector open = open_plane(facets.normal[f]);
        const SkyVector sky = sky_of(views, facets, f);
        const bool level = facets.normal[f].z() > 0.5f;
        for (std::size_t k = 1; k < sky_functions; ++k) {
            CAPTURE(f, k);
            if (level && views.sky[f] == 1.0f) CHECK(sky[k] == open[k]);
            CHECK(double{sky[k]} == Approx(double{open[k]}).margin(level ? 1e-6 : 0.03));
        }
    }
}
