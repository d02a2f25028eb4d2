// Pictures of scenes whose radiance is known in closed form: from the mesh by rays, exchange and
// renderer to the pixels, each within 1e-3. View factors: Howell, A Catalog of Radiation Transfer
// Configuration Factors.

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/radiance.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

/// Grey surfaces without air under a black sky of 3 K.
struct World {
    FacetSet facets;
    std::vector<Material> all;
    std::vector<float> temperature, sun;
    Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();
    double sun_zenith_deg = 180.0;
    std::optional<MoonLight> moon;

    /// A parallelogram in n × n squares; its normal is along a × b.
    void plate(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               int n, double reflectance, float kelvins) {
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                vertex.push_back(corner + double(i) / n * a + double(j) / n * b);
            }
        }
        const auto row = static_cast<std::uint32_t>(n + 1);
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t k = j * row + i;
                triangle.push_back({k, k + 1, k + row + 1});
                triangle.push_back({k, k + row + 1, k + row});
            }
        }
        mesh(vertex, triangle, reflectance, kelvins);
    }
    void mesh(const std::vector<Eigen::Vector3d>& vertex,
              const std::vector<std::array<std::uint32_t, 3>>& triangle, double reflectance,
              float kelvins) {
        all.push_back(
            testing::material("grey" + std::to_string(all.size()), flat_spectrum(reflectance)));
        append_facets(
            facets, vertex, triangle,
            std::vector<MaterialId>(triangle.size(), MaterialId{std::uint16_t(all.size() - 1)}),
            ObjectId{0});
        temperature.resize(facets.size(), kelvins);
    }
    /// Radiance of every pixel.
    std::vector<float> picture(const Observer& eye, const Band& band, int rays, int bounces = 2) {
        const RayScene scene(facets);
        const FacetViews sky = facet_views(facets, scene, {.rays = rays});
        const MaterialLibrary materials(all);
        const Atmosphere air = Vacuum{.space_temperature = 3.0};
        const View view = cast_view(scene, facets, eye, {.samples = 16});
        return render(view, eye, {&band, 1},
                      {.facets = facets,
                       .views = sky,
                       .materials = materials,
                       .atmosphere = air,
                       .temperature = temperature,
                       .sun_fraction = sun,
                       .to_sun = to_sun,
                       .sun_zenith_deg = sun_zenith_deg,
                       .moon = moon},
                      {.bounces = bounces})["radiance." + band.name]
            .pixel;
    }
};

double mean(const std::vector<float>& pixels) {
    double sum = 0.0;
    for (const float p : pixels) sum += double{p};
    return sum / double(pixels.size());
}

/// Parallel rays upon a square of `width` [m] about `target`.
Observer upon(const Eigen::Vector3d& target, const Eigen::Vector3d& from, double width, int size) {
    Observer eye;
    eye.projection = Projection::orthographic;
    eye.position = from;
    eye.picture_width = width;
    eye.width = eye.height = size;
    return looking_at(eye, target);
}

const Band lwir = flat_band("8-12", 8.0, 12.0, bin_edges_um());

}  // namespace

// L = ρ E cosθ / π, whatever the direction it is seen from.
TEST_CASE("the picture of an irradiated plate is Lambert's law",
          "[render][closed_form][by_comparison]") {
    const Band band = flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    World world;
    const Eigen::Vector3d across = Eigen::Vector3d(1.0, 0.0, 0.3).normalized();
    const Eigen::Vector3d along = Eigen::Vector3d::UnitY();
    world.plate(-5.0 * across - 5.0 * along, 10.0 * across, 10.0 * along, 2, 0.4, 3.0f);
    world.sun.assign(world.facets.size(), 1.0f);
    world.to_sun = direction(130.0, 35.0);
    world.sun_zenith_deg = 55.0;
    const Atmosphere none = Vacuum{};
    const double irradiance =
        band_sum_nodes(band, solar_at_nodes(none, 0.0, 55.0, 1.0, band.node_um));
    const double expected =
        0.4 * irradiance * across.cross(along).dot(world.to_sun) / std::numbers::pi;
    for (const Eigen::Vector3d& from :
         {Eigen::Vector3d(0, 0, 50), Eigen::Vector3d(-30, 5, 40), Eigen::Vector3d(10, -40, 9)}) {
        for (const float radiance : world.picture(upon({0, 0, 0}, from, 0.5, 4), band, 16)) {
            CAPTURE(from.transpose());
            CHECK(double{radiance} == Approx(expected).epsilon(1e-3));
        }
    }
}

// Magnitudes (Allen 1976): the sun -26.75, the full moon -12.73, at 90° of phase
// -12.73 + 0.026 · 90 + 4e-9 · 90⁴ = -10.13.
TEST_CASE("moonlight on a plate is sunlight by the difference of their magnitudes",
          "[render][closed_form][moon]") {
    const Band band = flat_band("0.545-0.555", 0.545, 0.555, bin_edges_um());
    World world;
    world.plate({-5, -5, 0}, 10.0 * Eigen::Vector3d::UnitX(), 10.0 * Eigen::Vector3d::UnitY(), 2,
                0.4, 3.0f);
    world.sun.assign(world.facets.size(), 1.0f);
    world.to_sun = direction(130.0, 35.0);
    world.sun_zenith_deg = 55.0;
    const auto radiance = [&] {
        return mean(world.picture(upon({0, 0, 0}, {-30, 5, 40}, 0.5, 4), band, 16));
    };
    const double by_sun = radiance();
    world.moon = MoonLight{};
    CHECK(by_sun / radiance() == Approx(std::pow(10.0, 0.4 * (26.75 - 12.73))).epsilon(0.01));
    world.moon->phase_deg = 90.0;
    CHECK(by_sun / radiance() == Approx(std::pow(10.0, 0.4 * (26.75 - 10.13))).epsilon(0.01));
}

// Equal squares a side apart (C-11): with X = Y = 1,
// F = 2/π [ln √(4/3) + 2√2 arctan(1/√2) − 2 arctan 1] = 0.199825.
// J1 = (ε B1 + ρ F ε B2) / (1 − ρ² F²) over the plate; what goes on after two bounces is at most
// ρ³ F³ (B2 − B1).
TEST_CASE("two facing plates are as bright as their radiosities",
          "[render][closed_form][by_comparison]") {
    const double factor =
        2.0 / std::numbers::pi *
        (std::log(std::sqrt(4.0 / 3.0)) + 2.0 * std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) -
         2.0 * std::atan(1.0));
    REQUIRE(factor == Approx(0.199825).epsilon(1e-5));
    const double reflectance = GENERATE(0.1, 0.3), emissivity = 1.0 - reflectance;
    World world;
    world.plate({0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 12, reflectance,
                290.0f);
    world.plate({0, 0, 1}, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), 12, reflectance,
                400.0f);
    // Below them cold ground, as what goes down past the edge of a scene meets ground like it.
    world.plate({-100, -100, -0.01}, 200.0 * Eigen::Vector3d::UnitX(),
                200.0 * Eigen::Vector3d::UnitY(), 1, 0.0, 60.0f);
    const double one = band_radiance(lwir, 290.0), two = band_radiance(lwir, 400.0);
    const double exchange = reflectance * factor;
    const double exact = emissivity * (one + exchange * two) / (1.0 - exchange * exchange);
    const double left = std::pow(exchange, 3) * (two - one);
    CAPTURE(reflectance, left / exact);
    REQUIRE(left / exact < 1e-3);
    // Between the plates, straight down upon the lower one.
    const std::vector<float> picture =
        world.picture(upon({0.5, 0.5, 0.0}, {0.5, 0.5, 0.99}, 1.0, 48), lwir, 1024);
    CHECK(mean(picture) == Approx(exact).epsilon(1e-3));
}

// Two squares at right angles with a common edge (C-14 with H = W = 1):
// F = 1/π [2 arctan 1 − √2 arctan(1/√2) + ¼ ln(4/3 (3/4)²)] = 0.200044.
TEST_CASE("ground in front of a hot wall reflects it", "[render][closed_form]") {
    const double root = std::sqrt(2.0);
    const double factor = (2.0 * std::atan(1.0) - root * std::atan(1.0 / root) +
                           0.25 * std::log(4.0 / 3.0 * std::pow(3.0 / 4.0, 2))) /
                          std::numbers::pi;
    REQUIRE(factor == Approx(0.200044).epsilon(1e-5));
    const double reflectance = 0.2, emissivity = 0.8;
    World world;
    world.plate({0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 16, reflectance,
                290.0f);
    world.plate({0, 1, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 16, 0.0, 450.0f);
    const double ground = band_radiance(lwir, 290.0), wall = band_radiance(lwir, 450.0);
    const std::vector<float> picture =
        world.picture(upon({0.5, 0.5, 0.0}, {0.5, 0.5, 20.0}, 1.0, 48), lwir, 1024);
    // The wall is black: nothing comes back.
    CHECK(mean(picture) == Approx(emissivity * ground + reflectance * factor * wall).epsilon(1e-3));
}

// A black sphere of radius r over a plate sends each of its points F = r² cosθ / d² of its
// radiance's hemisphere, d and θ to its centre, as long as all of it is above the plate's horizon.
TEST_CASE("a sphere over a plate irradiates it by the inverse square",
          "[render][closed_form][by_comparison]") {
    World world;
    constexpr double radius = 1.0, height = 2.5, reflectance = 0.3;
    constexpr int around = 64, up = 32;
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    // A polyhedron's mean cross-section is a quarter of its surface: scaled to that of the sphere.
    double surface = 0.0;
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i < around; ++i) {
            const double a = 2.0 * std::numbers::pi * i / around, b = std::numbers::pi * j / up;
            vertex.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
        }
    }
    const auto at = [](int j, int i) { return std::uint32_t(j * around + i % around); };
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < around; ++i) {
            if (j > 0) triangle.push_back({at(j, i), at(j, i + 1), at(j + 1, i)});
            if (j + 1 < up) triangle.push_back({at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)});
        }
    }
    for (const auto& t : triangle) {
        surface += 0.5 * (vertex[t[1]] - vertex[t[0]]).cross(vertex[t[2]] - vertex[t[0]]).norm();
    }
    const double scale = radius * std::sqrt(4.0 * std::numbers::pi / surface);
    for (Eigen::Vector3d& v : vertex) v = scale * v + Eigen::Vector3d(0, 0, height);
    world.mesh(vertex, triangle, 0.0, 400.0f);
    for (const double aside : {0.0, 1.0, 2.5}) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.3 + k * std::numbers::pi / 4.0;
            const double x = aside * std::cos(angle) + (aside == 0.0 ? 0.05 * (k - 4) : 0.0);
            world.plate({x - 0.01, aside * std::sin(angle) - 0.01, 0.0},
                        0.02 * Eigen::Vector3d::UnitX(), 0.02 * Eigen::Vector3d::UnitY(), 1,
                        reflectance, 300.0f);
        }
    }
    const double plate = band_radiance(lwir, 300.0), sphere = band_radiance(lwir, 400.0);
    const RayScene scene(world.facets);
    const FacetViews sky = facet_views(world.facets, scene, {.rays = 4096});
    const MaterialLibrary materials(world.all);
    const Atmosphere air = Vacuum{.space_temperature = 3.0};
    const RadianceInput input{.facets = world.facets,
                              .views = sky,
                              .materials = materials,
                              .atmosphere = air,
                              .temperature = world.temperature};
    std::size_t facet = triangle.size();
    for (const double aside : {0.0, 1.0, 2.5}) {
        double expected = 0.0, found = 0.0;
        for (int k = 0; k < 16; ++k, ++facet) {
            const Eigen::Vector3d to =
                Eigen::Vector3d(0, 0, height) - world.facets.centroid[facet].cast<double>();
            const double factor = radius * radius * (to.z() / to.norm()) / to.squaredNorm();
            expected += ((1.0 - reflectance) * plate + reflectance * factor * sphere) / 16.0;
            for (const double term :
                 radiance_at_eye(input, lwir, {5.0, SurfaceId{std::uint32_t(facet)}, 5.0, 0.0})) {
                found += term / 16.0;
            }
        }
        CAPTURE(aside);
        CHECK(found == Approx(expected).epsilon(1e-3));
    }
}
