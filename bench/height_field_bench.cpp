// The march over the grid beside robust rays: horizons, sky view and a day of shadows on fractal
// relief (1001² posts, 10 m apart, 1200 m high), one core, by the processor's own clock. Errors:
// rms degrees of horizons against bisection with Embree rays; rms sky view against 256 azimuths;
// share of wrong decisions (more or less than half of the sun) against Embree.

#include "terrain/relief/height_field.hpp"
#include "terrain/relief/horizon.hpp"
#include "terrain/relief/relief_sky.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <ctime>
#include <functional>
#include <random>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/even_field.hpp"

using namespace diurna;

namespace {

constexpr int side = 1001;
constexpr double step = 10.0;
constexpr double lift = 0.5;  // [m] of the eye: a ray that starts in the ground means nothing

double seconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

/// Diamond-square relief, roughness falling by half per octave.
std::vector<float> fractal(int posts, double relief) {
    int n = 1;
    while (n + 1 < posts) n *= 2;
    const int s = n + 1;
    std::vector<float> z(std::size_t(s) * s, 0.0f);
    std::mt19937 random(42);
    std::normal_distribution<float> normal;
    const auto at = [&](int x, int y) -> float& { return z[std::size_t(y) * s + x]; };
    float spread = 1.0f;
    for (int cell = n; cell > 1; cell /= 2, spread *= 0.5f) {
        const int half = cell / 2;
        for (int y = half; y < s; y += cell) {
            for (int x = half; x < s; x += cell) {
                at(x, y) = (at(x - half, y - half) + at(x + half, y - half) +
                            at(x - half, y + half) + at(x + half, y + half)) /
                               4.0f +
                           spread * normal(random);
            }
        }
        for (int y = 0; y < s; y += half) {
            for (int x = (y / half) % 2 ? 0 : half; x < s; x += cell) {
                float sum = 0.0f;
                int count = 0;
                const auto add = [&](int i, int j) {
                    if (i < 0 || j < 0 || i >= s || j >= s) return;
                    sum += at(i, j);
                    ++count;
                };
                add(x - half, y), add(x + half, y), add(x, y - half), add(x, y + half);
                at(x, y) = sum / static_cast<float>(count) + 0.7f * spread * normal(random);
            }
        }
    }
    std::vector<float> up(std::size_t(posts) * posts);
    float low = 1e9f, high = -1e9f;
    for (int y = 0; y < posts; ++y) {
        for (int x = 0; x < posts; ++x) {
            const float h = at(x, y);
            low = std::min(low, h);
            high = std::max(high, h);
            up[std::size_t(y) * posts + x] = h;
        }
    }
    for (float& h : up) h = static_cast<float>((h - low) * relief / (high - low));
    return up;
}

FacetSet facets_of(const HeightField& field) {
    std::vector<Eigen::Vector3d> vertex;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const Eigen::Vector2d p = field.place({column, row});
            vertex.emplace_back(p.x(), p.y(), field.up(row, column));
        }
    }
    std::vector<std::array<std::uint32_t, 3>> triangle;
    for (int row = 0; row + 1 < field.rows(); ++row) {
        for (int column = 0; column + 1 < field.columns(); ++column) {
            const auto a = static_cast<std::uint32_t>(row * field.columns() + column);
            const auto b = a + 1, c = a + static_cast<std::uint32_t>(field.columns()), d = c + 1;
            triangle.push_back({a, d, b});
            triangle.push_back({a, c, d});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
    return facets;
}

/// The horizon by bisection with robust rays.
double horizon_by_rays(const RayScene& rays, const Eigen::Vector3f& post, double azimuth_deg) {
    double low = 0.0, high = 89.0;
    for (int pass = 0; pass < 40; ++pass) {
        const double middle = 0.5 * (low + high);
        const Ray ray{.origin = post, .direction = direction(azimuth_deg, middle).cast<float>()};
        std::uint8_t blocked = 0;
        rays.occluded({&ray, 1}, {&blocked, 1});
        (blocked ? low : high) = middle;
    }
    return low;
}

void row(const std::string& method, const std::string& setting, double cpu, double error,
         const char* unit) {
    fmt::print("fractal,{},{},{},1,{:.4f},{:.2g},{}\n", method, setting, side * side, cpu, error,
               unit);
}

/// Horizons against bisection with rays at 250 posts of each azimuth.
void horizon_rows(const HeightField& field, const RayScene& rays) {
    const std::vector<double> azimuths{7.3, 33.1, 71.9, 122.4, 158.6, 203.7, 251.2, 301.8};
    std::vector<float> tangent(field.size());
    double cpu = 0.0, sum = 0.0, worst = 0.0;
    int count = 0;
    std::mt19937 random(1);
    for (const double azimuth_deg : azimuths) {
        cpu += seconds([&] { horizon(field, azimuth_deg, tangent, lift); });
        for (int k = 0; k < 250; ++k) {
            const int x = 1 + int(random() % (side - 2)), y = 1 + int(random() % (side - 2));
            const Eigen::Vector2d p = field.place({x, y});
            const double seen = degrees(std::atan(double{tangent[std::size_t(y) * side + x]}));
            const double by_rays = horizon_by_rays(
                rays, Eigen::Vector3d(p.x(), p.y(), field.up(y, x) + lift).cast<float>(),
                azimuth_deg);
            sum += (seen - by_rays) * (seen - by_rays);
            worst = std::max(worst, std::abs(seen - by_rays));
            ++count;
        }
    }
    row("horizon", fmt::format("{} azimuths", azimuths.size()), cpu, std::sqrt(sum / count), "deg");
    fmt::print(stderr, "{:.1f} M posts azimuths/s, worst {:.5f} deg\n",
               1e-6 * double(azimuths.size() * field.size()) / cpu, worst);
}

/// Sky views against one of 256 azimuths.
void sky_view_rows(const HeightField& field) {
    std::vector<float> fine(field.size()), view(field.size());
    sky_view(field, 256, fine);
    for (const int n : {8, 16, 32, 64}) {
        const double time = seconds([&] { sky_view(field, n, view); });
        double squares = 0.0;
        for (std::size_t i = 0; i < view.size(); ++i) {
            squares += (view[i] - fine[i]) * (view[i] - fine[i]);
        }
        row("sky_view", fmt::format("{} azimuths", n), time,
            std::sqrt(squares / double(view.size())), "1");
        fmt::print(stderr, "{:.2f} us a post\n", 1e6 * time / double(field.size()));
    }
}

/// Posts in the sun or not, every third of them, against a ray each.
struct Wrong {
    std::size_t wrong = 0, tried = 0;
    void count(const HeightField& field, const RayScene& rays, const Eigen::Vector3d& sun,
               const std::vector<float>& fraction) {
        std::vector<Ray> ray;
        std::vector<std::size_t> owner;
        for (std::size_t k = 0; k < field.size(); k += 3) {
            const int x = int(k) % side, y = int(k) / side;
            const Eigen::Vector2d p = field.place({x, y});
            ray.push_back(
                {.origin = Eigen::Vector3d(p.x(), p.y(), field.up(y, x) + lift).cast<float>(),
                 .direction = sun.cast<float>()});
            owner.push_back(k);
        }
        std::vector<std::uint8_t> blocked(ray.size());
        rays.occluded(ray, blocked);
        for (std::size_t k = 0; k < ray.size(); ++k) {
            wrong += (fraction[owner[k]] < 0.5f) != (blocked[k] != 0);
        }
        tried += ray.size();
    }
};

/// A summer day at 46.5 N: sunlit instants every six minutes.
void sun_fraction_row(const HeightField& field, const RayScene& rays) {
    const Site site{46.5, 8.0, 0.0};
    std::vector<float> fraction(field.size());
    int instants = 0;
    Wrong posts;
    double time = 0.0;
    const Instant midnight = parse_instant("2026-06-20T00:00:00+01:00");
    for (int i = 0; i < 240; ++i) {
        const Eigen::Vector3d sun = sun_direction(sun_position(site, later(midnight, 360.0 * i)));
        if (sun.z() <= 0.0 || instants == 153) continue;
        ++instants;
        time += seconds([&] { sun_fraction(field, sun, fraction, lift); });
        if (instants % 10 == 0) posts.count(field, rays, sun, fraction);
    }
    row("sun_fraction", fmt::format("{} instants", instants), time,
        double(posts.wrong) / double(posts.tried), "share wrong");
}

}  // namespace

int main() {
    set_thread_count(1);
    const std::vector<float> up = fractal(side, 1200.0);
    const HeightField field = even_field(side, side, up, step);
    const RayScene rays(facets_of(field));
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    horizon_rows(field, rays);
    sky_view_rows(field);
    sun_fraction_row(field, rays);
}
