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
    /// - first: number of the first sample, 0 or, of more, as many as were taken already
    SunRays(const FacetSet& facets, const Eigen::Vector3d& direction,
            const SunFractionOptions& options, int samples, int first)
        : facets_(facets),
          direction_(direction),
          disc_(direction),
          options_(options),
          samples_(samples),
          first_(first) {
        std::tie(columns_, rows_) = nearly_square(samples);
    }

    /// Appends those of one facet; none where it is turned away. The part of the disc under the
    /// facet's own plane does not shine on it.
    void append(std::size_t facet) {
        const LiftedFacet points(facets_, facet);
        if (points.normal.dot(direction_) <= 0.0) return;
        Uniform random(options_.seed, facet);
        const double start_y = random(), start_x = random();
        if (first_ > 0) random = Uniform(options_.seed + golden_step, facet);
        for (int k = 0; k < samples_; ++k) {
            const double down = random(), across = random();
            const Eigen::Vector3d towards =
                disc_.towards((k % columns_ + across) / columns_, (k / columns_ + down) / rows_);
            if (points.normal.dot(towards) <= 0.0) continue;
            const Eigen::Vector2d place = evenly(first_ + k, {start_x, start_y});
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
    int samples_, first_;
    int columns_, rows_;
};

/// Rays from facets to the sun.
struct SunOverScene {
    const FacetSet& facets;
    const RayScene& scene;
    const Eigen::Vector3d& direction;
    const SunFractionOptions& options;
};

/// Sets the share of chosen facets to the mean of some samples.
void sample(const SunOverScene& over, std::span<const std::uint32_t> chosen,
            std::span<float> fraction, int samples, int first) {
    for (const std::uint32_t f : chosen) fraction[f] = 0.0f;
    for_each_block(chosen.size(), facets_per_sun_block, [&](std::size_t begin, std::size_t end) {
        SunRays sun(over.facets, over.direction, over.options, samples, first);
        sun.rays.reserve((end - begin) * std::size_t(samples));
        sun.owner.reserve(sun.rays.capacity());
        for (std::size_t k = begin; k < end; ++k) sun.append(chosen[k]);
        std::vector<float> share(sun.rays.size());
        over.scene.beam(sun.rays, share);
        for (std::size_t i = 0; i < share.size(); ++i) fraction[sun.owner[i]] += share[i];
        for (std::size_t k = begin; k < end; ++k) {
            fraction[chosen[k]] /= static_cast<float>(samples);
        }
    });
}

/// Those of the chosen facets that an edge of a shadow may cross.
std::vector<std::uint32_t> at_edges(const FacetSet& facets, const Eigen::Vector3d& direction,
                                    std::span<const std::uint32_t> chosen,
                                    std::span<const float> fraction) {
    const Eigen::Vector3f to_sun = direction.cast<float>();
    std::vector<float> least(facets.vertex.size(), 1.0f), most(facets.vertex.size(), 0.0f);
    const auto is_lit = [&](std::uint32_t f) { return facets.normal[f].dot(to_sun) > 0.0f; };
    for (const std::uint32_t f : chosen) {
        if (!is_lit(f)) continue;
        for (const std::uint32_t v : facets.corner[f]) {
            least[v] = std::min(least[v], fraction[f]);
            most[v] = std::max(most[v], fraction[f]);
        }
    }
    std::vector<std::uint32_t> edges;
    for (const std::uint32_t f : chosen) {
        if (!is_lit(f)) continue;
        const auto& [a, b, c] = facets.corner[f];
        if (std::max({most[a], most[b], most[c]}) > std::min({least[a], least[b], least[c]})) {
            edges.push_back(f);
        }
    }
    return edges;
}

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
    if (direction.z() <= 0.0) {
        for (const std::uint32_t f : chosen) fraction[f] = 0.0f;
        return;
    }
    const SunOverScene over{facets, scene, direction, options};
    sample(over, chosen, fraction, options.samples, 0);
    if (options.edge_samples == 0) return;
    const std::vector<std::uint32_t> edges = at_edges(facets, direction, chosen, fraction);
    std::vector<float> before;
    for (const std::uint32_t f : edges) before.push_back(fraction[f]);
    sample(over, edges, fraction, options.edge_samples, options.samples);
    const float share = float(options.samples) / float(options.samples + options.edge_samples);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        fraction[edges[k]] += share * (before[k] - fraction[edges[k]]);
    }
}

}  // namespace diurna
