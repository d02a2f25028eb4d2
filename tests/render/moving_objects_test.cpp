#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "materials/base/units.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_sun.hpp"
#include "terrain/visibility/sun_fraction.hpp"

// A bar that goes east over a floor, seen straight from above while its shutter is open: a pixel is
// a decimetre at the floor's level.

using namespace diurna;

namespace {

constexpr int width = 96, height = 4;

/// From `west` to `east` and far north and south, at a height.
void append_strip(FacetSet& facets, double west, double east, double up, ObjectId id) {
    const std::vector<Eigen::Vector3d> vertex = {
        {west, -50, up}, {east, -50, up}, {east, 50, up}, {west, 50, up}};
    const std::vector<std::array<std::uint32_t, 3>> square = {{0, 1, 2}, {0, 2, 3}};
    append_facets(facets, vertex, square, std::vector<MaterialId>(2, MaterialId{0}), id);
}

struct Scene {
    FacetSet facets;
    FacetMotion motion;
    Observer observer;

    /// - way: that the bar goes from the picture's begin to its end [m]
    Scene(double from, double to, double up, double way) {
        // The floor in strips of a metre, so that a shadow has facets to fall on.
        for (int x = -20; x < 20; ++x) append_strip(facets, x, x + 1.0, 0.0, ObjectId{0});
        const std::size_t still = facets.vertex.size();
        append_strip(facets, from, to, up, ObjectId{1});
        motion = {facets.vertex, facets.vertex};
        for (std::size_t v = still; v < facets.vertex.size(); ++v) {
            motion.before[v].x() -= float(0.5 * way);
            motion.after[v].x() += float(0.5 * way);
        }
        observer.position = {0.0, 0.0, 20.0};
        observer.elevation_deg = -90.0;
        observer.width = width;
        observer.height = height;
        observer.projection = Projection::orthographic;
        observer.picture_width = 0.1 * width;
        observer.exposure = 0.02;
    }
    RayScene rays() const { return RayScene(facets, {}, {}, motion); }

    /// (column) Share of the second row's pixels that sees the bar.
    std::vector<double> bar(const View& view) const {
        std::vector<double> share(width, 0.0);
        for (std::size_t p = width; p < 2 * width; ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (facets.object[index(view.surface[s.target])] != ObjectId{1}) continue;
                share[p - width] += double{s.weight};
            }
        }
        return share;
    }
};

/// What of a pixel's width and the exposure a bar from -a to a covers that goes `way` meanwhile,
/// evenly about 0: the integral of clamped ramps, in closed form.
double trapezoid(double column, double a, double way) {
    // The integral of max(0, x) twice over pixel and way.
    const auto ramp = [](double x) { return x > 0.0 ? 0.5 * x * x : 0.0; };
    const double left = 0.1 * (column - width / 2.0), right = left + 0.1;
    const auto covered_until = [&](double edge) {  // mean share of [left, right] west of the edge
        const double lo = edge - 0.5 * way, hi = edge + 0.5 * way;
        return (ramp(hi - left) - ramp(lo - left) - ramp(hi - right) + ramp(lo - right)) /
               (way * 0.1);
    };
    return covered_until(a) - covered_until(-a);
}

}  // namespace

TEST_CASE("a bar that moves while the shutter is open has a trapezoid's profile",
          "[render][motion][by_comparison]") {
    // The bar is longer than its way, and then shorter: a plateau of 1, and of 0.6 / 2.
    for (const auto& [half, way] : {std::pair{1.0, 0.8}, {0.3, 2.0}}) {
        const Scene scene(-half, half, 0.5, way);
        const View view = cast_view(scene.rays(), scene.facets, scene.observer, {.samples = 1024});
        const std::vector<double> found = scene.bar(view);
        CAPTURE(half, way);
        double sum = 0.0;
        for (int column = 0; column < width; ++column) {
            CAPTURE(column);
            CHECK(found[column] == Approx(trapezoid(column, half, way)).margin(0.01));
            sum += 0.1 * found[column];
        }
        CHECK(sum == Approx(2.0 * half).epsilon(2e-3));
        CHECK(found[width / 2] == Approx(std::min(1.0, 2.0 * half / way)).margin(0.01));
    }
}

TEST_CASE("a camera that moves with the bar sees it sharp and the floor blurred",
          "[render][motion]") {
    Scene scene(-1.0, 1.0, 0.5, 0.8);
    scene.observer.velocity = {0.8 / 0.02, 0.0, 0.0};
    // A mark on the floor, beside the bar's way.
    append_strip(scene.facets, 2.0, 2.5, 0.01, ObjectId{2});
    for (auto* places : {&scene.motion.before, &scene.motion.after}) {
        places->insert(places->end(), scene.facets.vertex.end() - 4, scene.facets.vertex.end());
    }
    const View view = cast_view(scene.rays(), scene.facets, scene.observer, {.samples = 256});
    const std::vector<double> found = scene.bar(view);
    for (int column = 0; column < width; ++column) {
        CAPTURE(column);
        const double east = 0.1 * (column - width / 2.0) + 0.05;
        CHECK(found[column] == Approx(std::abs(east) < 1.0 ? 1.0 : 0.0).margin(1e-6));
    }
    // The mark is smeared over 0.8 m and nowhere whole: 0.5 / 0.8.
    double most = 0.0;
    for (std::size_t p = width; p < 2 * width; ++p) {
        double share = 0.0;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            const Sighting& s = view.sighting[k];
            if (scene.facets.object[index(view.surface[s.target])] == ObjectId{2}) {
                share += double{s.weight};
            }
        }
        most = std::max(most, share);
    }
    CHECK(most == Approx(0.5 / 0.8).margin(0.01));
}

TEST_CASE("rows that are read in turn see the bar where it is by then", "[render][motion]") {
    // 0.2 m a row; the first one's exposure is in the middle of the time of rays.
    Scene scene(-1.0, 1.0, 0.5, 2.0 * 0.2 * (height - 1));
    scene.observer.exposure = 0.0;
    scene.observer.row_time = 1e-3;
    const View view = cast_view(scene.rays(), scene.facets, scene.observer, {.samples = 64});
    for (int row = 0; row < height; ++row) {
        double middle = 0.0, all = 0.0;
        for (std::size_t p = std::size_t(row) * width; p < std::size_t(row + 1) * width; ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (scene.facets.object[index(view.surface[s.target])] != ObjectId{1}) continue;
                all += double{s.weight};
                middle += double{s.weight} * 0.1 * (double(p % width) - width / 2.0 + 0.5);
            }
        }
        CHECK(middle / all == Approx(0.2 * row).margin(5e-3));
    }
}

TEST_CASE("the shadow of a moving object is blurred with it", "[render][motion][sun]") {
    // A sun 45 degrees high in the west: the shadow of the bar 2 m up lies 2 m east of it, in view.
    constexpr double way = 0.8;
    const Scene scene(-0.6, 0.6, 2.0, way);
    const RayScene rays = scene.rays();
    const ViewOptions options{.samples = 256};
    const View view = cast_view(rays, scene.facets, scene.observer, options);
    const Eigen::Vector3d to_sun = Eigen::Vector3d(-1.0, 0.0, 1.0).normalized();
    const auto fraction = [&](float time) {
        std::vector<float> all(scene.facets.size());
        sun_fraction(scene.facets, rays, to_sun, all, {.samples = 16, .time = time});
        return all;
    };
    const std::vector<float> middle = fraction(0.5f), before = fraction(0.0f),
                             after = fraction(1.0f);
    const SunOverFacets sun{rays, scene.facets, middle, to_sun, {before, after}};
    const PixelSun found = cast_pixel_sun(view, sun, scene.observer, options);
    std::vector<double> lit(width, 0.0), floor(width, 0.0);
    for (std::size_t k = 0; k < found.pixel.size(); ++k) {
        if (found.pixel[k] / width != 1) continue;
        for (std::uint32_t e = found.row[k]; e < found.row[k + 1]; ++e) {
            const Sighting& s = view.sighting[found.sighting[e]];
            if (scene.facets.object[index(view.surface[s.target])] != ObjectId{0}) continue;
            lit[found.pixel[k] % width] += double{s.weight} * double{found.share[e]};
            floor[found.pixel[k] % width] += double{s.weight};
        }
    }
    // The sun's disc adds a penumbra of 2 sqrt(2) sqrt(2) m times 9.3 mrad, 0.04 m; its samples,
    // one each of the pixel's, leave sqrt(0.25 / 256) of noise; where the first sixteen are alike
    // the others are not asked: a sixteenth. Columns that the bar itself covers
    // in part tell the floor's share alone, and are skipped.
    int seen = 0;
    for (int column = 0; column < width; ++column) {
        if (floor[column] < 0.99) continue;
        const double east = 0.1 * (column - width / 2.0) + 0.05;
        if (east < 1.1) continue;
        ++seen;
        CAPTURE(column);
        CHECK(lit[column] / floor[column] ==
              Approx(1.0 - trapezoid(column - 20, 0.6, way)).margin(1.0 / 16.0 + 0.03));
    }
    CHECK(seen >= 16);
}
