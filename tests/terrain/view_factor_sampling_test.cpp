#include "terrain/visibility/view_factor_sampling.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/sun_fraction.hpp"

// Closed forms: radiative transfer texts for canyon, shaft and wall; Ingersoll et al. (1992) for
// the bowl (every facet of a spherical cap sees the same share of sky). Rays are random: a mean
// over n facets of 64 stratified rays has a standard error of about 0.03/√n.

using namespace diurna;
using std::numbers::pi;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Mesh {
    std::vector<Eigen::Vector3d> vertex;
    Triangles triangle;

    /// A sheet of nu × nv quads, place(u, v) over the unit square; its front is where u × v points.
    void sheet(int nu, int nv, const std::function<Eigen::Vector3d(double, double)>& place) {
        const auto first = static_cast<std::uint32_t>(vertex.size());
        for (int j = 0; j <= nv; ++j) {
            for (int i = 0; i <= nu; ++i) vertex.push_back(place(double(i) / nu, double(j) / nv));
        }
        const auto at = [&](int i, int j) {
            return first + static_cast<std::uint32_t>(j * (nu + 1) + i);
        };
        for (int j = 0; j < nv; ++j) {
            for (int i = 0; i < nu; ++i) {
                triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    }
    FacetSet facets() const {
        FacetSet set;
        append_facets(set, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
        return set;
    }
};

/// A spherical cap as a bowl of diameter 2 and depth 2q, rim at height 0.
struct Bowl {
    double q;
    double radius() const { return (1.0 + 4.0 * q * q) / (4.0 * q); }
    FacetSet facets(int rings, int sectors) const {
        Mesh mesh;
        const double r = radius(), half_angle = q == 0.5 ? pi / 2 : std::asin(1.0 / r);
        mesh.sheet(rings, sectors, [&](double u, double v) -> Eigen::Vector3d {
            const double polar = half_angle * u, around = 2.0 * pi * v;
            const double centre_height = r - 2.0 * q;
            return {r * std::sin(polar) * std::cos(around), r * std::sin(polar) * std::sin(around),
                    centre_height - r * std::cos(polar)};
        });
        return mesh.facets();
    }
};

struct Mean {
    double sum = 0.0, weight = 0.0;
    void add(double value, double w) {
        sum += value * w;
        weight += w;
    }
    double value() const { return sum / weight; }
};

/// Mean sky view over the facets that a place satisfies, weighted by area.
double mean_sky_view(const FacetSet& facets, const FacetViewOptions& options,
                     const std::function<bool(const Eigen::Vector3f&)>& chosen) {
    const FacetViews view = facet_views(facets, RayScene(facets), options);
    Mean mean;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (chosen(facets.centroid[f])) mean.add(view.sky[f], facets.area[f]);
    }
    REQUIRE(mean.weight > 0.0);
    return mean.value();
}

constexpr double far_along = 2000.0;  // half length of what represents infinite, in widths

}  // namespace

TEST_CASE("every part of a bowl sees the same share of sky",
          "[terrain][visibility][sky][by_comparison]") {
    struct Case {
        double q, sky_view;
    };
    const auto [q, expected] =
        GENERATE(values<Case>({{0.1, 0.961538462}, {0.2, 0.862068966}, {0.5, 0.5}}));
    const FacetSet facets = Bowl{q}.facets(48, 192);
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 64});
    Mean all, centre, rim;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        all.add(view.sky[f] + view.below[f], facets.area[f]);
        const float distance = facets.centroid[f].head<2>().norm();
        if (distance < 0.3f) centre.add(view.sky[f], facets.area[f]);
        if (distance > 0.8f) rim.add(view.sky[f] + view.below[f], facets.area[f]);
    }
    CAPTURE(q);
    CHECK(all.value() == Approx(expected).margin(5e-4));
    CHECK(centre.value() == Approx(expected).margin(2e-3));
    CHECK(rim.value() == Approx(expected).margin(2e-3));
}

TEST_CASE("sixteen times the rays, an error at least six times smaller",
          "[terrain][visibility][order][by_replication]") {
    // Stratified rays: error ∝ rays^-3/4, eight times; independent ones would give four.
    const FacetSet facets = Bowl{0.5}.facets(48, 192);
    const RayScene scene(facets);
    const auto rms = [&](int rays) {
        const FacetViews view = facet_views(facets, scene, {.rays = rays});
        double sum = 0.0;
        for (const float seen : view.sky) sum += (seen - 0.5) * (seen - 0.5);
        return std::sqrt(sum / static_cast<double>(facets.size()));
    };
    CHECK(rms(64) < 0.65 / std::pow(64, 0.75) * 1.05);
    CHECK(rms(16) / rms(256) > 6.0);
}

TEST_CASE("a V valley sees cos of its slope, least at the bottom",
          "[terrain][visibility][sky][by_comparison]") {
    // Wall length 1, slope b; at s from the bottom 1/2 [1 - (cos w - s) / sqrt(1 + s² - 2 s cos
    // w)], w = 180° - 2b.
    const double b = GENERATE(30.0, 45.0) * pi / 180.0;
    Mesh mesh;
    const int across = 64;
    for (const double side : {-1.0, 1.0}) {
        mesh.sheet(across, 3, [&](double u, double v) -> Eigen::Vector3d {
            const double y = std::pow(2.0 * v - 1.0, 3) * far_along;  // short facets mid-way
            return {side * u * std::cos(b), side * y, u * std::sin(b)};
        });
    }
    const FacetSet facets = mesh.facets();
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 4096});
    Mean mean;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (std::abs(facets.centroid[f].y()) > 0.1 * far_along) continue;
        const double seen = view.sky[f] + view.below[f];
        mean.add(seen, facets.area[f]);
        const double s = facets.centroid[f].head<2>().cast<double>().x() / std::cos(b);
        const double w = pi - 2.0 * b, at = std::abs(s);
        const double exact =
            0.5 * (1.0 - (std::cos(w) - at) / std::sqrt(1.0 + at * at - 2.0 * at * std::cos(w)));
        CAPTURE(b, s);
        // 4096 stratified rays: 5 standard errors of 0.5/4096^0.75 = 1e-3, and the facet's width.
        CHECK(seen == Approx(exact).margin(6e-3));
    }
    CHECK(mean.value() == Approx(std::cos(b)).margin(5e-4));
}

TEST_CASE("the floor and walls of a street canyon see what their ratio says",
          "[terrain][visibility][sky][by_comparison]") {
    const double r = GENERATE(0.25, 0.5, 1.0, 2.0);  // height over width
    Mesh mesh;
    const auto y = [](double v) { return std::pow(2.0 * v - 1.0, 3) * far_along; };
    mesh.sheet(41, 3, [&](double u, double v) -> Eigen::Vector3d { return {u - 0.5, y(v), 0.0}; });
    mesh.sheet(3, 32, [&](double v, double u) -> Eigen::Vector3d { return {-0.5, y(v), r * u}; });
    mesh.sheet(3, 32, [&](double v, double u) -> Eigen::Vector3d { return {0.5, -y(v), r * u}; });
    const FacetSet facets = mesh.facets();
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 4096});
    Mean floor, wall, centre;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Eigen::Vector3f c = facets.centroid[f];
        if (std::abs(c.y()) > 0.1 * far_along) continue;
        const bool on_floor = facets.normal[f].z() > 0.5f;
        // A wall facet also sees, above the opposite wall's far end, nothing but sky.
        (on_floor ? floor : wall).add(view.sky[f] + view.below[f], facets.area[f]);
        if (on_floor && std::abs(c.x()) < 0.02f) centre.add(view.sky[f], facets.area[f]);
    }
    const double root = std::sqrt(1.0 + r * r);
    CAPTURE(r);
    CHECK(floor.value() == Approx(root - r).margin(1e-3));
    CHECK(wall.value() == Approx((1.0 + r - root) / (2.0 * r)).margin(1e-3));
    CHECK(centre.value() == Approx(1.0 / std::sqrt(1.0 + 4.0 * r * r)).margin(2e-3));
}

TEST_CASE("a wall hides half its angle's cosine from the ground", "[terrain][visibility][sky]") {
    const double ratio = GENERATE(0.25, 0.5, 1.0, 2.0, 4.0);  // height over distance
    Mesh mesh;
    mesh.sheet(8, 8, [](double u, double v) -> Eigen::Vector3d {
        return {0.004 * (u - 0.5), 0.004 * (v - 0.5), 0.0};
    });
    mesh.sheet(1, 1, [&](double v, double u) -> Eigen::Vector3d {
        return {1.0, (1.0 - 2.0 * v) * far_along, ratio * u};
    });
    const double seen = mean_sky_view(mesh.facets(), {.rays = 1024}, [](const Eigen::Vector3f& c) {
        return std::abs(c.x()) < 0.01f;
    });
    CHECK(seen == Approx(0.5 * (1.0 + std::cos(std::atan(ratio)))).margin(1e-3));
}

TEST_CASE("the bottom of a shaft sees its mouth", "[terrain][visibility][sky]") {
    struct Case {
        double width_over_depth, square;
    };
    const auto [a, square] =
        GENERATE(values<Case>({{1.0, 0.239456470}, {2.0, 0.554126424}, {4.0, 0.831028500}}));
    const auto spot = [](Mesh& mesh) {
        mesh.sheet(8, 8, [](double u, double v) -> Eigen::Vector3d {
            return {0.004 * (u - 0.5), 0.004 * (v - 0.5), 0.0};
        });
    };
    const auto near_axis = [](const Eigen::Vector3f& c) { return c.norm() < 0.01f; };
    const double half = 0.5 * a;
    SECTION("square") {
        Mesh mesh;
        spot(mesh);
        for (int side = 0; side < 4; ++side) {
            const Eigen::AngleAxisd turn(side * pi / 2, Eigen::Vector3d::UnitZ());
            mesh.sheet(1, 1, [&](double u, double v) -> Eigen::Vector3d {
                return turn * Eigen::Vector3d(half, (1.0 - 2.0 * u) * half, v);
            });
        }
        CHECK(mean_sky_view(mesh.facets(), {.rays = 1024}, near_axis) ==
              Approx(square).margin(1e-3));
    }
    SECTION("round") {
        Mesh mesh;
        spot(mesh);
        mesh.sheet(720, 1, [&](double u, double v) -> Eigen::Vector3d {
            return {half * std::cos(2 * pi * u), -half * std::sin(2 * pi * u), v};
        });
        CHECK(mean_sky_view(mesh.facets(), {.rays = 1024}, near_axis) ==
              Approx(half * half / (half * half + 1.0)).margin(1e-3));
    }
}

TEST_CASE("a lone slope sees the sky above the horizontal and nothing below it",
          "[terrain][visibility][sky]") {
    const double slope = GENERATE(0.0, 30.0, 60.0, 90.0) * pi / 180.0;
    Mesh mesh;
    mesh.sheet(16, 16, [&](double u, double v) -> Eigen::Vector3d {
        return {u * std::cos(slope), v, u * std::sin(slope)};
    });
    const FacetSet facets = mesh.facets();
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 64});
    Mean sky, below;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        sky.add(view.sky[f], 1.0);
        below.add(view.below[f], 1.0);
    }
    CHECK(sky.value() == Approx(0.5 * (1.0 + std::cos(slope))).margin(2e-3));
    CHECK(below.value() == Approx(0.5 * (1.0 - std::cos(slope))).margin(2e-3));
    CHECK(view.others.facet.empty());
}

TEST_CASE("sky, ground below and exchange make one whole",
          "[terrain][visibility][exchange][by_trace]") {
    const FacetSet facets = Bowl{0.3}.facets(24, 96);
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 64});
    REQUIRE(view.others.row.size() == facets.size() + 1);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        double whole = double{view.sky[f]} + view.below[f];
        for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
            whole += view.others.factor[k];
            CHECK(view.others.factor[k] > 0.0f);
            CHECK(view.others.facet[k] != f);
            if (k > view.others.row[f]) {
                CHECK(view.others.facet[k - 1] < view.others.facet[k]);
            }
        }
        CHECK(whole == Approx(1.0).epsilon(1e-6));
    }
}

TEST_CASE("exchange is reciprocal: area times factor both ways",
          "[terrain][visibility][exchange]") {
    // Left and right half of a bowl, each some 2000 facets: Σ A_i F_ij is the same either way.
    const FacetSet facets = Bowl{0.3}.facets(24, 96);
    const FacetViews view = facet_views(facets, RayScene(facets), {.rays = 256});
    double to_east = 0.0, to_west = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
            const bool from_east = facets.centroid[f].x() > 0.3f;
            const bool at_east = facets.centroid[view.others.facet[k]].x() > 0.3f;
            const double flow = double{facets.area[f]} * view.others.factor[k];
            if (from_east && !at_east) to_west += flow;
            if (!from_east && at_east) to_east += flow;
        }
    }
    CHECK(to_east == Approx(to_west).epsilon(5e-3));
}

TEST_CASE("the shadow in a bowl covers the share that geometry says",
          "[terrain][visibility][sun][by_comparison]") {
    // F2: shaded share of the plan area (2 cos² e/π)(acos k - k √(1 - k²)), k = β tan(e)/2,
    // β = 1/(2q) - 2q, zero where k ≥ 1. A point sun in the formula; the disc's penumbra is even.
    const double q = GENERATE(0.1, 0.2, 0.5);
    const double elevation_deg = GENERATE(5.0, 10.0, 20.0, 30.0, 40.0);
    const double e = elevation_deg * pi / 180.0;
    const double k = (1.0 / (2.0 * q) - 2.0 * q) * std::tan(e) / 2.0;
    const double exact =
        k >= 1.0 ? 0.0
                 : 2.0 * std::cos(e) * std::cos(e) / pi * (std::acos(k) - k * std::sqrt(1 - k * k));

    const FacetSet facets = Bowl{q}.facets(128, 512);
    const RayScene scene(facets);
    std::vector<float> fraction(facets.size());
    sun_fraction(facets, scene, direction(70.0, elevation_deg), fraction, {.samples = 4});
    Mean shaded;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        shaded.add(1.0 - fraction[f], facets.area[f] * facets.normal[f].z());
    }
    CAPTURE(q, elevation_deg);
    CHECK(shaded.value() == Approx(exact).margin(2e-3));
}

TEST_CASE("the sun illuminates one side, and the disc fades over its width",
          "[terrain][visibility][sun]") {
    Mesh mesh;
    mesh.sheet(8, 8, [](double u, double v) -> Eigen::Vector3d { return {u, v, 0.0}; });
    const FacetSet facets = mesh.facets();
    const RayScene scene(facets);
    std::vector<float> fraction(facets.size(), 9.0f);
    const auto mean_at = [&](double elevation_deg) {
        sun_fraction(facets, scene, direction(30.0, elevation_deg), fraction, {.samples = 64});
        Mean mean;
        for (const float x : fraction) mean.add(x, 1.0);
        return mean.value();
    };
    CHECK(mean_at(-1.0) == 0.0);
    CHECK(mean_at(0.3) == 1.0);
    CHECK(mean_at(40.0) == 1.0);
    // Centre on the horizon half a radius up: the disc's share above is 1 - (acos(h) - h√(1-h²))/π.
    const double h = 0.5;
    const double share = 1.0 - (std::acos(h) - h * std::sqrt(1.0 - h * h)) / pi;
    CHECK(mean_at(h * degrees(sun_angular_radius)) == Approx(share).margin(5e-3));
}

TEST_CASE("a wall's shadow ends where the sun's ray over its top comes down",
          "[terrain][visibility][sun]") {
    Mesh mesh;
    const int n = 200;
    mesh.sheet(n, 4, [](double u, double v) -> Eigen::Vector3d { return {10 * u, v - 0.5, 0.0}; });
    mesh.sheet(1, 1, [](double v, double u) -> Eigen::Vector3d {
        return {-1e-3, 200.0 * (v - 0.5), 2.0 * u};
    });
    const FacetSet facets = mesh.facets();
    std::vector<float> fraction(facets.size());
    sun_fraction(facets, RayScene(facets), direction(270.0, 30.0), fraction, {.samples = 16});
    double shaded = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.normal[f].z() > 0.5f) shaded += (1.0 - fraction[f]) * facets.area[f];
    }
    CHECK(shaded == Approx(2.0 / std::tan(pi / 6)).margin(0.01));  // width 1
}

TEST_CASE("any number of threads gives the same bytes",
          "[terrain][visibility][invariance][by_replication]") {
    const FacetSet facets = Bowl{0.25}.facets(32, 96);
    const RayScene scene(facets);
    std::vector<FacetViews> views;
    std::vector<std::vector<float>> fractions;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        views.push_back(facet_views(facets, scene));
        fractions.emplace_back(facets.size());
        sun_fraction(facets, scene, direction(111.0, 12.0), fractions.back());
    }
    set_thread_count(0);
    for (std::size_t i = 1; i < views.size(); ++i) {
        CHECK(views[i].sky == views[0].sky);
        CHECK(views[i].below == views[0].below);
        CHECK(views[i].others.row == views[0].others.row);
        CHECK(views[i].others.facet == views[0].others.facet);
        CHECK(views[i].others.factor == views[0].others.factor);
        CHECK(fractions[i] == fractions[0]);
    }
}
