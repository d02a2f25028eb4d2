#include "terrain/visibility/sun_fraction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/lifted_facet.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_block = 128;

/// A stream of uniform numbers in [0, 1) of one facet.
class Uniform {
 public:
    Uniform(std::uint64_t seed, std::size_t facet) : state_(hashed(seed ^ hashed(facet))) {}
    double operator()() {
        state_ = hashed(state_);
        return unit_interval(state_);
    }

 private:
    std::uint64_t state_;
};

/// The unit square to the unit disc, equal areas to equal areas, neighbours to neighbours
/// (Shirley & Chiu 1997).
Eigen::Vector2d to_disc(double u, double v) {
    const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    if (a == 0.0 && b == 0.0) return {0.0, 0.0};
    constexpr double quarter = std::numbers::pi / 4.0;
    const bool flat = std::abs(a) > std::abs(b);
    const double radius = flat ? a : b;
    const double angle = flat ? quarter * (b / a) : 2.0 * quarter - quarter * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The k-th of a sequence that fills the unit square evenly (Roberts' R2), from a random start.
Eigen::Vector2d evenly(int k, const Eigen::Vector2d& start) {
    const double x = start.x() + even_step_x * k, y = start.y() + even_step_y * k;
    return {x - std::floor(x), y - std::floor(y)};
}

/// Rays from points of facets to points of the sun's disc.
class SunRays {
 public:
    SunRays(const FacetSet& facets, const Eigen::Vector3d& direction,
            const SunFractionOptions& options)
        : facets_(facets), direction_(direction), options_(options) {
        std::tie(east_, north_) = tangents(direction);
        std::tie(columns_, rows_) = nearly_square(options.samples);
    }

    /// Appends those of one facet; none where it is turned away. The part of the disc under the
    /// facet's own plane does not shine on it.
    void append(std::size_t facet) {
        const LiftedFacet points(facets_, facet);
        if (points.normal.dot(direction_) <= 0.0) return;
        Uniform random(options_.seed, facet);
        const double start_y = random(), start_x = random();
        for (int k = 0; k < options_.samples; ++k) {
            const double down = random(), across = random();
            const Eigen::Vector2d disc = disc_radius_ * to_disc((k % columns_ + across) / columns_,
                                                                (k / columns_ + down) / rows_);
            const Eigen::Vector3d towards =
                (direction_ + disc.x() * east_ + disc.y() * north_).normalized();
            if (points.normal.dot(towards) <= 0.0) continue;
            const Eigen::Vector2d place = evenly(k, {start_x, start_y});
            rays.push_back(
                {.origin = points.at(place.x(), place.y()), .direction = towards.cast<float>()});
            owner.push_back(static_cast<std::uint32_t>(facet));
        }
    }

    std::vector<Ray> rays;
    std::vector<std::uint32_t> owner;  // (ray) facet

 private:
    const FacetSet& facets_;
    const Eigen::Vector3d& direction_;
    const SunFractionOptions& options_;
    Eigen::Vector3d east_, north_;
    int columns_, rows_;
    double disc_radius_ = std::tan(sun_angular_radius);
};

}  // namespace

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options) {
    std::vector<std::uint32_t> all(facets.size());
    std::iota(all.begin(), all.end(), 0u);
    sun_fraction(facets, scene, direction, all, fraction, options);
}

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint32_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options) {
    assert(fraction.size() == facets.size());
    assert(options.samples > 0);
    for (const std::uint32_t f : chosen) fraction[f] = 0.0f;
    if (direction.z() <= 0.0) return;

    for_each_block(chosen.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        SunRays sun(facets, direction, options);
        for (std::size_t k = begin; k < end; ++k) sun.append(chosen[k]);
        std::vector<float> share(sun.rays.size());
        scene.beam(sun.rays, share);
        for (std::size_t i = 0; i < share.size(); ++i) fraction[sun.owner[i]] += share[i];
        for (std::size_t k = begin; k < end; ++k) {
            fraction[chosen[k]] /= static_cast<float>(options.samples);
        }
    });
}

}  // namespace diurna
