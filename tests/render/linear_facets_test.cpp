#include "render/view/linear_facets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "materials/base/parallel.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/place/site.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;
using namespace diurna::testing;

namespace {

constexpr double side = 60.0;  // [m]

/// Level or rolling ground of triangles of some size and any shape, without air.
struct Field {
    FacetSet facets;
    MaterialLibrary materials{
        {material("ground", flat_spectrum(0.1)), material("other", flat_spectrum(0.1))}};
    std::vector<float> fraction{};
    Eigen::Vector3d to_sun = direction(150.0, 40.0);

    /// - edge: [m]; relief: [m]; other_from: [m] east, where the other material begins
    explicit Field(double edge, double relief = 0.0, double other_from = 1e9) {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> chance(-0.3, 0.3);
        const int n = static_cast<int>(side / edge);
        std::vector<Eigen::Vector3d> vertex;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                const bool free = i > 0 && i < n && j > 0 && j < n;
                const double x = edge * (i + (free ? chance(random) : 0.0)) - 0.5 * side;
                const double y = edge * (j + (free ? chance(random) : 0.0)) - 0.5 * side;
                vertex.emplace_back(x, y, relief * std::sin(x / 9.0) * std::cos(y / 11.0));
            }
        }
        std::vector<std::array<std::uint32_t, 3>> triangle;
        std::vector<MaterialId> of;
        const auto row = static_cast<std::uint32_t>(n + 1);
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t k = j * row + i;
                triangle.push_back({k, k + 1, k + row + 1});
                triangle.push_back({k, k + row + 1, k + row});
                const bool other = edge * (i + 0.5) - 0.5 * side > other_from;
                of.insert(of.end(), 2, MaterialId{std::uint16_t(other)});
            }
        }
        append_facets(facets, vertex, triangle, of, ObjectId{0});
    }
    std::vector<FacetSlope> slopes(const std::vector<float>& temperature) const {
        const RayScene rays(facets);
        std::vector<SurfaceId> all;
        for (std::size_t f = 0; f < facets.size(); ++f) all.push_back(SurfaceId{std::uint32_t(f)});
        return facet_slopes(CornerFits(facets, all),
                            {.sun = {rays, facets, fraction, to_sun}, .temperature = temperature});
    }
    /// (facet) [K] at the centroids
    template <class Law>
    std::vector<float> by(const Law& law) const {
        std::vector<float> kelvins;
        for (const auto& c : facets.centroid) kelvins.push_back(float(law(c.x(), c.y())));
        return kelvins;
    }
    bool inner(std::size_t f, double margin) const {
        return facets.centroid[f].head<2>().cwiseAbs().maxCoeff() < 0.5 * side - margin;
    }
    bool touch(std::size_t a, std::size_t b) const {
        for (const auto u : facets.corner[a]) {
            for (const auto v : facets.corner[b]) {
                if (u == v) return true;
            }
        }
        return false;
    }
};

Observer camera() {
    Observer eye;
    eye.position = {5.0, -70.0, 45.0};
    eye.width = 200;
    eye.height = 160;
    eye.horizontal_fov_deg = 30.0;
    return looking_at(eye, {2.0, 1.0, 0.0});
}

/// Of a field as a camera sees it in 3-5 and 8-12 µm, without air and sky.
struct Seen {
    View view;
    LinearFacets ground;
    Frame flat, linear;  // facets at their mean, and linear within them

    Seen(const Field& field, const std::vector<float>& temperature, const Observer& eye) {
        const RayScene rays(field.facets);
        view = cast_view(rays, field.facets, eye, {.samples = 16});
        ground = linear_facets(view, eye, CornerFits(field.facets, facets_with_slopes(view)),
                               {.sun = {rays, field.facets, field.fraction, field.to_sun},
                                .temperature = temperature});
        flat = picture(field, temperature, eye, nullptr);
        linear = picture(field, temperature, eye, &ground);
    }
    Frame picture(const Field& field, const std::vector<float>& temperature, const Observer& eye,
                  const LinearFacets* of) const {
        const Atmosphere none = Vacuum{.space_temperature = 3.0};
        FacetViews views;
        views.sky.assign(field.facets.size(), 1.0f);
        views.below.assign(field.facets.size(), 0.0f);
        views.others.row.assign(field.facets.size() + 1, 0);
        const std::vector<Band> bands{flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                                      flat_band("8-12", 8.0, 12.0, bin_edges_um())};
        return render(view, eye, bands,
                      {.facets = field.facets,
                       .views = views,
                       .materials = field.materials,
                       .atmosphere = none,
                       .temperature = temperature,
                       .sun_fraction = field.fraction,
                       .to_sun = field.to_sun,
                       .sun_zenith_deg = 50.0},
                      {.ground = of});
    }
};

/// Root mean square of the difference of two planes, over pixels that show ground alone, in both.
double rms(const Seen& a, const std::vector<float>& p, const Seen& b, const std::vector<float>& q) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        if (a.view.sky[k] > 0.0f || b.view.sky[k] > 0.0f) continue;
        sum += std::pow(double{p[k]} - double{q[k]}, 2);
        ++count;
    }
    return std::sqrt(sum / double(count));
}

}  // namespace

TEST_CASE("a temperature linear in place has its slope in each facet", "[render][linear_facets]") {
    const Field field(GENERATE(3.0, 6.0), GENERATE(0.0, 2.0));
    const auto kelvins = field.by([](double x, double y) { return 290.0 + 0.13 * x - 0.07 * y; });
    const auto slopes = field.slopes(kelvins);
    for (std::size_t f = 0; f < slopes.size(); ++f) {
        if (!field.inner(f, 13.0)) continue;
        CHECK(slopes[f].per_metre.x() == Approx(0.13).epsilon(2e-3));
        CHECK(slopes[f].per_metre.y() == Approx(-0.07).epsilon(2e-3));
    }
}

TEST_CASE("within a facet the mean stays except for chance, and no place is beyond its neighbours",
          "[render][linear_facets]") {
    const Field field(4.0, 1.0);
    std::mt19937 random(GENERATE(1, 2, 3));
    std::uniform_real_distribution<float> chance(280.0f, 310.0f);
    std::vector<float> kelvins;
    for (std::size_t f = 0; f < field.facets.size(); ++f) kelvins.push_back(chance(random));
    const auto slopes = field.slopes(kelvins);
    std::size_t sloping = 0;
    for (std::size_t f = 0; f < slopes.size(); ++f) {
        float low = kelvins[f], high = kelvins[f];
        for (std::size_t o = 0; o < slopes.size(); ++o) {
            if (!field.touch(f, o)) continue;
            low = std::min(low, kelvins[o]);
            high = std::max(high, kelvins[o]);
        }
        double mean = 0.0;
        for (const auto v : field.facets.corner[f]) {
            const Eigen::Vector3f off = field.facets.vertex[v] - field.facets.centroid[f];
            const double at = double{kelvins[f]} + double{slopes[f].offset} +
                              double{slopes[f].per_metre.dot(off)};
            mean += at / 3.0;
            CHECK(at > low - 1e-3f);
            CHECK(at < high + 1e-3f);
        }
        CHECK(mean == Approx(double{kelvins[f]} + double{slopes[f].offset}).margin(1e-3));
        CHECK(std::abs(slopes[f].offset) < 1.13f * chance_difference);
        sloping += !slopes[f].per_metre.isZero();
    }
    CHECK(sloping > slopes.size() / 2);
}

// Two even temperatures: any slope would come from across the border.
TEST_CASE("a smooth temperature with chance in each facet has no steps and less of the chance",
          "[render][linear_facets]") {
    // Around an inner corner lie about six facets: their weighted mean has a sixth of the variance,
    // and a place between three corners still less. Of 0.05 K at most half remains.
    const Field field(3.0);
    const auto law = [](double x, double y) { return 290.0 + 0.05 * x - 0.03 * y; };
    std::mt19937 random(4);
    std::normal_distribution<float> chance(0.0f, 0.05f);
    std::vector<float> kelvins = field.by(law);
    for (float& kelvin : kelvins) kelvin += chance(random);
    const auto slopes = field.slopes(kelvins);
    const auto at = [&](std::size_t f, const Eigen::Vector3f& place) {
        return kelvins[f] + slopes[f].at(place - field.facets.centroid[f]);
    };
    double steps = 0.0, square = 0.0, bias = 0.0;
    std::size_t edges = 0, inner = 0;
    for (std::size_t f = 0; f < kelvins.size(); ++f) {
        if (!field.inner(f, 9.0)) continue;
        const Eigen::Vector3f middle = field.facets.centroid[f];
        const double off = double{at(f, middle)} - law(double{middle.x()}, double{middle.y()});
        square += off * off;
        bias += off;
        ++inner;
        for (std::size_t o = 0; o < f; ++o) {
            std::vector<std::uint32_t> common;
            for (const auto u : field.facets.corner[f]) {
                for (const auto v : field.facets.corner[o]) {
                    if (u == v) common.push_back(u);
                }
            }
            if (common.size() < 2) continue;
            const Eigen::Vector3f edge =
                0.5f * (field.facets.vertex[common[0]] + field.facets.vertex[common[1]]);
            steps = std::max(steps, double{std::abs(at(f, edge) - at(o, edge))});
            ++edges;
        }
    }
    REQUIRE(edges > 100);
    CAPTURE(steps, std::sqrt(square / double(inner)), bias / double(inner));
    CHECK(steps < 0.02);  // 0.2 K if each kept its mean; the limit by the range leaves some
    CHECK(std::sqrt(square / double(inner)) < 0.025);
    CHECK(std::abs(bias / double(inner)) < 0.005);
}

TEST_CASE("a wall has the slopes that ground has", "[render][linear_facets]") {
    // The same facets and temperatures, lying and upright: the same, place by place.
    const Field lying(3.0);
    const auto kelvins = lying.by([](double x, double y) { return 290.0 + 0.05 * x - 0.03 * y; });
    Field wall(3.0);
    const auto upright = [](const Eigen::Vector3f& v) {
        return Eigen::Vector3f(v.x(), -v.z(), v.y());
    };
    for (auto& v : wall.facets.vertex) v = upright(v);
    for (auto& c : wall.facets.centroid) c = upright(c);
    for (auto& n : wall.facets.normal) n = upright(n);
    for (auto& object : wall.facets.object) object = ObjectId{1};
    const auto ground = lying.slopes(kelvins), slopes = wall.slopes(kelvins);
    std::size_t sloping = 0;
    for (std::size_t f = 0; f < slopes.size(); ++f) {
        for (const auto v : lying.facets.corner[f]) {
            const Eigen::Vector3f off = lying.facets.vertex[v] - lying.facets.centroid[f];
            CHECK(slopes[f].at(upright(off)) == Approx(ground[f].at(off)).margin(1e-4));
        }
        sloping += !slopes[f].flat();
    }
    CHECK(sloping > slopes.size() / 2);
}

TEST_CASE("no temperature crosses a border of materials or the edge of a shadow",
          "[render][linear_facets]") {
    const bool of_material = GENERATE(true, false);
    Field field(3.0, 0.0, of_material ? 0.0 : 1e9);
    std::vector<float> kelvins;
    for (const auto& c : field.facets.centroid) {
        const bool east = c.x() > 0.0f;
        kelvins.push_back(east ? 310.0f : 290.0f);
        field.fraction.push_back(of_material || east ? 1.0f : 0.0f);
    }
    // Centroids of one material lie on one side only if vertices on the border have not moved.
    for (std::size_t f = 0; of_material && f < kelvins.size(); ++f) {
        kelvins[f] = field.facets.material[f] == MaterialId{1} ? 310.0f : 290.0f;
    }
    const auto reaches_across = [&] {
        std::size_t count = 0;
        for (const FacetSlope& slope : field.slopes(kelvins)) {
            CHECK(slope.per_metre.isZero());  // a step has no slope that would not go beyond it
            count += slope.high - slope.low > 0.0f;
        }
        return count;
    };
    CHECK(reaches_across() == 0);
    if (of_material) return;
    // Without sun the same temperatures are those of one surface.
    field.fraction.clear();
    CHECK(reaches_across() > 20);
}

// A facet that turns away from the sun has no shadow's edge to one that the sun grazes.
TEST_CASE("where the sun only grazes the ground, its edge is no shadow's",
          "[render][linear_facets]") {
    Field field(3.0);
    field.to_sun = direction(150.0, 0.5);
    std::vector<float> kelvins;
    for (const auto& c : field.facets.centroid) {
        kelvins.push_back(290.0f + 0.1f * c.x());
        field.fraction.push_back(c.x() > 0.0f ? 1.0f : 0.0f);
    }
    const auto slopes = field.slopes(kelvins);
    for (std::size_t f = 0; f < slopes.size(); ++f) {
        if (field.inner(f, 7.0)) CHECK(slopes[f].per_metre.x() == Approx(0.1).epsilon(2e-3));
    }
}

// A smooth law on facets of 6 m, against the same on facets of 1.5 m.
TEST_CASE("linear within facets, a picture is nearer to that of facets four times finer",
          "[render][linear_facets][order]") {
    const auto law = [](double x, double y) {
        return 290.0 + 4.0 * std::sin(x / 14.0) * std::cos(y / 17.0) + 0.05 * x;
    };
    const Field coarse(6.0), fine(1.5);
    const Observer eye = camera();
    const Seen seen(coarse, coarse.by(law), eye), truth(fine, fine.by(law), eye);
    for (const char* plane : {"apparent_temperature.3-5", "apparent_temperature.8-12"}) {
        const auto& of = truth.linear[plane].pixel;
        const double flat = rms(seen, seen.flat[plane].pixel, truth, of);
        const double linear = rms(seen, seen.linear[plane].pixel, truth, of);
        CAPTURE(plane, flat, linear);
        CHECK(linear < 0.3 * flat);
        CHECK(linear < 0.1);
    }
}

TEST_CASE("truth at a pixel's centre is what the picture shows there",
          "[render][linear_facets][truth]") {
    const Field field(5.0, 1.0);
    const auto law = [](double x, double y) { return 290.0 + 0.1 * x + 0.05 * y; };
    const Seen seen(field, field.by(law), camera());
    const auto& truth = seen.linear["temperature"].pixel;
    const auto& flat = seen.flat["temperature"].pixel;
    const PixelRays rays = pixel_rays(camera());
    double worst = 0.0, worst_flat = 0.0;
    for (std::size_t p = 0; p < truth.size(); ++p) {
        const FacetId f = seen.view.centre[p];
        if (f == no_facet || !field.inner(index(f), 12.0)) continue;
        const std::size_t width = std::size_t(seen.view.width);
        const Eigen::Vector3d at =
            camera().position + double{seen.view.centre_range[p]} *
                                    rays.towards(double(p % width) + 0.5, double(p / width) + 0.5);
        worst = std::max(worst, std::abs(double{truth[p]} - law(at.x(), at.y())));
        worst_flat = std::max(worst_flat, std::abs(double{flat[p]} - law(at.x(), at.y())));
    }
    CAPTURE(worst, worst_flat);
    CHECK(worst < 0.02);
    CHECK(worst_flat > 0.1);
}

// The parabola through three temperatures, against ground of each temperature by itself.
TEST_CASE("ground up to 5 K from its facet's mean emits as that temperature does",
          "[render][linear_facets]") {
    const Field field(15.0);
    const Observer eye = camera();
    // Two facets have the coldest and the hottest temperature, which set the range of the tables.
    const std::size_t last = field.facets.size() - 1;
    const auto temperature = [&](float kelvins) {
        std::vector<float> all(field.facets.size(), kelvins);
        all[0] = 284.0f;
        all[last] = 296.0f;
        return all;
    };
    Seen seen(field, temperature(290.0f), eye);
    const auto extreme = [&](const Sighting& s) {
        const std::size_t f = index(seen.view.surface[s.target]);
        return f == 0 || f == last;
    };
    const std::vector<float> steps{-5.0f, -4.0f, -2.5f, -0.7f, 0.0f, 0.3f, 1.8f, 3.7f, 5.0f};
    seen.ground.warmer.assign(seen.view.sighting.size(), 0.0f);
    seen.ground.warmer_centre.assign(seen.view.pixels(), 0.0f);
    std::size_t extremes = 0;
    for (std::size_t p = 0; p < seen.view.pixels(); ++p) {
        for (std::uint32_t k = seen.view.row[p]; k < seen.view.row[p + 1]; ++k) {
            extremes += extreme(seen.view.sighting[k]);
            if (!extreme(seen.view.sighting[k])) seen.ground.warmer[k] = steps[p % steps.size()];
        }
    }
    REQUIRE(extremes > 0);
    const Frame found = seen.picture(field, temperature(290.0f), eye, &seen.ground);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Frame expected = seen.picture(field, temperature(290.0f + steps[i]), eye, nullptr);
        double worst = 0.0;
        for (const char* plane : {"apparent_temperature.3-5", "apparent_temperature.8-12"}) {
            for (std::size_t p = i; p < seen.view.pixels(); p += steps.size()) {
                if (seen.view.sky[p] > 0.0f) continue;
                worst = std::max(worst, std::abs(double{found[plane].pixel[p]} -
                                                 double{expected[plane].pixel[p]}));
            }
        }
        CAPTURE(steps[i], worst);
        CHECK(worst < 8e-3);
    }
}

TEST_CASE("temperatures within facets are the same bytes on any number of threads",
          "[render][linear_facets][threads]") {
    const Field field(2.0, 2.0);
    const auto kelvins = field.by(
        [](double x, double y) { return 290.0 + 5.0 * std::sin(x / 7.0) * std::cos(y / 5.0); });
    set_thread_count(1);
    const Seen one(field, kelvins, camera());
    set_thread_count(4);
    const Seen four(field, kelvins, camera());
    set_thread_count(0);
    CHECK(one.ground.warmer == four.ground.warmer);
    for (const char* plane : {"radiance.3-5", "radiance.8-12", "temperature"}) {
        const auto &a = one.linear[plane].pixel, &b = four.linear[plane].pixel;
        CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
    }
}
