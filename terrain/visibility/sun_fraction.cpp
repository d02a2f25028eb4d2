#include "terrain/visibility/sun_fraction.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <vector>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "terrain/visibility/lifted_facet.hpp"
#include "terrain/visibility/sun_disc.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_sun_block = 128;

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

/// Rays from points of facets to points of the sun's disc.
class SunRays {
 public:
    SunRays(const FacetSet& facets, const Eigen::Vector3d& direction,
            const SunFractionOptions& options)
        : facets_(facets), direction_(direction), disc_(direction), options_(options) {
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
            const Eigen::Vector3d towards =
                disc_.towards((k % columns_ + across) / columns_, (k / columns_ + down) / rows_);
            if (points.normal.dot(towards) <= 0.0) continue;
            const Eigen::Vector2d place = evenly(k, {start_x, start_y});
            rays.push_back({.origin = points.at(place.x(), place.y()),
                            .direction = towards.cast<float>(),
                            .time = options_.time});
            owner.push_back(static_cast<std::uint32_t>(facet));
        }
    }

    std::vector<Ray> rays;
    std::vector<std::uint32_t> owner;  // (ray) facet

 private:
    const FacetSet& facets_;
    const Eigen::Vector3d& direction_;
    SunDisc disc_;
    const SunFractionOptions& options_;
    int columns_, rows_;
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

    for_each_block(chosen.size(), facets_per_sun_block, [&](std::size_t begin, std::size_t end) {
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
