#include "terrain/visibility/facet_views.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/sky_bound.hpp"
#include "terrain/visibility/sky_rays.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_block = 128;
constexpr std::size_t facets_per_bound = 32;  // neighbours along Morton's curve

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

/// One block's rows of the exchange matrix.
struct FactorRows {
    std::vector<std::uint32_t> length;  // (facet of the block)
    std::vector<FacetId> facet;
    std::vector<float> factor;

    /// Appends a row from the facets that were hit, one entry each, by rising number.
    void append(std::span<FacetId> seen, double weight) {
        std::sort(seen.begin(), seen.end());
        const std::size_t before = facet.size();
        for (std::size_t i = 0; i < seen.size();) {
            std::size_t j = i;
            while (j < seen.size() && seen[j] == seen[i]) ++j;
            facet.push_back(seen[i]);
            factor.push_back(static_cast<float>(weight * static_cast<double>(j - i)));
            i = j;
        }
        length.push_back(static_cast<std::uint32_t>(facet.size() - before));
    }
};

/// Rays of many facets one behind the other, handed on sixteen at a time.
struct RayQueue {
    static constexpr std::size_t room = 32;
    std::array<float, room> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
    std::array<std::uint32_t, room> owner;
    std::size_t size = 0;

    void put(const RayPacket& rays, std::size_t k, std::uint32_t from, bool wanted) {
        origin_x[size] = rays.origin_x[k];
        origin_y[size] = rays.origin_y[k];
        origin_z[size] = rays.origin_z[k];
        direction_x[size] = rays.direction_x[k];
        direction_y[size] = rays.direction_y[k];
        direction_z[size] = rays.direction_z[k];
        owner[size] = from;
        size += wanted;
    }

    /// Takes out the first `count`, at most 16.
    void take(std::size_t count, RayPacket& rays, std::array<std::uint32_t, 16>& owners) {
        const auto first = [&](auto& all, auto& some) {
            std::copy_n(all.begin(), 16, some.begin());
            std::copy_n(all.begin() + 16, 16, all.begin());
        };
        first(origin_x, rays.origin_x);
        first(origin_y, rays.origin_y);
        first(origin_z, rays.origin_z);
        first(direction_x, rays.direction_x);
        first(direction_y, rays.direction_y);
        first(direction_z, rays.direction_z);
        first(owner, owners);
        size -= count;
    }
};

/// What the rays of one block of facets meet. Those above everything round about meet the sky. Of
/// the others first is asked whether anything stands in their way, the cheapest question; only
/// where it does, for the nearest facet.
class BlockRays {
 public:
    BlockRays(const RayScene& scene, bool nearest) : scene_(scene), nearest_(nearest) {}

    /// `sines`: of the elevations above which there is only sky.
    void trace(const RayPacket& rays, int lanes, std::uint32_t from, const SkyBound::Sines& sines) {
        const auto count = static_cast<std::size_t>(lanes);
        const std::size_t before = doubtful_.size;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t octant = SkyBound::octant(rays.direction_x[k], rays.direction_y[k]);
            doubtful_.put(rays, k, from, rays.direction_z[k] <= sines[octant]);
        }
        sky[from] += lanes - static_cast<int>(doubtful_.size - before);
        if (doubtful_.size >= 16) ask_whether(16);
    }

    void finish() {
        if (doubtful_.size > 0) ask_whether(doubtful_.size);
        if (blocked_.size > 0) ask_which(blocked_.size);
    }

    std::array<int, facets_per_block> sky{}, below{};  // (facet of the block) rays
    std::vector<std::uint32_t> owner;                  // (hit) rising
    std::vector<FacetId> facet;                        // (hit)

 private:
    void escaped(std::uint32_t from, float up) { ++(up >= 0.0f ? sky : below)[from]; }

    void ask_whether(std::size_t count) {
        doubtful_.take(count, packet_, owners_);
        std::array<std::uint8_t, 16> blocked;
        scene_.occluded(packet_, static_cast<int>(count), blocked);
        for (std::size_t k = 0; k < count; ++k) {
            if (!blocked[k]) escaped(owners_[k], packet_.direction_z[k]);
            blocked_.put(packet_, k, owners_[k], blocked[k] && nearest_);
        }
        if (blocked_.size >= 16) ask_which(16);
    }

    void ask_which(std::size_t count) {
        blocked_.take(count, packet_, owners_);
        std::array<std::uint32_t, 16> nearest;
        scene_.closest(packet_, static_cast<int>(count), nearest);
        for (std::size_t k = 0; k < count; ++k) {
            if (nearest[k] == index(no_facet)) {
                escaped(owners_[k], packet_.direction_z[k]);
                continue;
            }
            owner.push_back(owners_[k]);
            facet.push_back(FacetId{nearest[k]});
        }
    }

    const RayScene& scene_;
    bool nearest_;
    RayQueue doubtful_{}, blocked_{};
    RayPacket packet_{};
    std::array<std::uint32_t, 16> owners_{};
};

ViewFactors joined(const std::vector<FactorRows>& blocks, std::size_t facets) {
    ViewFactors exchange;
    std::size_t entries = 0;
    for (const FactorRows& block : blocks) entries += block.facet.size();
    exchange.row.reserve(facets + 1);
    exchange.facet.reserve(entries);
    exchange.factor.reserve(entries);
    exchange.row.push_back(0);
    for (const FactorRows& block : blocks) {
        for (const std::uint32_t length : block.length) {
            exchange.row.push_back(exchange.row.back() + length);
        }
        exchange.facet.insert(exchange.facet.end(), block.facet.begin(), block.facet.end());
        exchange.factor.insert(exchange.factor.end(), block.factor.begin(), block.factor.end());
    }
    return exchange;
}

}  // namespace

FacetViews facet_views(const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options) {
    assert(options.rays > 0 && options.rays <= 65535);
    assert(options.object_rays > 0 && options.object_rays <= 65535);
    const SkyRays ground_sampler(options.rays, options.seed);
    const SkyRays object_sampler(options.object_rays, options.seed);
    const SkyBound bound(facets);

    FacetViews view;
    view.rays.assign(facets.size(), static_cast<std::uint16_t>(options.rays));
    for (std::size_t f = options.first_object; f < facets.size(); ++f) {
        view.rays[f] = static_cast<std::uint16_t>(options.object_rays);
    }
    view.sky.resize(facets.size());
    view.below.resize(facets.size());
    std::vector<FactorRows> blocks((facets.size() + facets_per_block - 1) / facets_per_block);

    for_each_block(facets.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        RayPacket rays;
        BlockRays found(scene, options.others);
        SkyBound::Sines sines = SkyBound::unknown;
        for (std::size_t f = begin; f < end; ++f) {
            if ((f - begin) % facets_per_bound == 0) {
                sines = bound.sines(facets, f, std::min(end, f + facets_per_bound));
            }
            const SkyRays& sampler = f < options.first_object ? ground_sampler : object_sampler;
            for (std::size_t p = 0; p < sampler.packets(); ++p) {
                sampler.fill(facets, f, p, rays);
                found.trace(rays, sampler.lanes(p), static_cast<std::uint32_t>(f - begin), sines);
            }
        }
        found.finish();
        std::size_t hit = 0;
        for (std::size_t f = begin; f < end; ++f) {
            const std::size_t first = hit;
            while (hit < found.owner.size() && found.owner[hit] == f - begin) ++hit;
            const double weight = 1.0 / view.rays[f];
            blocks[begin / facets_per_block].append(
                std::span(found.facet).subspan(first, hit - first), weight);
            view.sky[f] = static_cast<float>(weight * found.sky[f - begin]);
            view.below[f] = static_cast<float>(weight * found.below[f - begin]);
        }
    });
    view.others = joined(blocks, facets.size());
    return view;
}

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options) {
    const std::vector<std::uint8_t> all(facets.size(), 1);
    sun_fraction(facets, scene, direction, all, fraction, options);
}

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint8_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options) {
    assert(fraction.size() == facets.size() && chosen.size() == facets.size());
    assert(options.samples > 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (chosen[f]) fraction[f] = 0.0f;
    }
    if (direction.z() <= 0.0) return;

    const auto [east, north] = tangents(direction);
    const double disc_radius = std::tan(sun_angular_radius);
    const auto samples = static_cast<std::size_t>(options.samples);
    const auto [columns, rows] = nearly_square(options.samples);

    for_each_block(facets.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Ray> rays;
        std::vector<std::uint32_t> owner;
        rays.reserve(samples * (end - begin));
        owner.reserve(samples * (end - begin));
        for (std::size_t f = begin; f < end; ++f) {
            if (!chosen[f]) continue;
            const LiftedFacet points(facets, f);
            if (points.normal.dot(direction) <= 0.0) continue;
            Uniform random(options.seed, f);
            const Eigen::Vector2d start(random(), random());
            for (std::size_t k = 0; k < samples; ++k) {
                const Eigen::Vector2d disc =
                    disc_radius * to_disc((static_cast<int>(k) % columns + random()) / columns,
                                          (static_cast<int>(k) / columns + random()) / rows);
                const Eigen::Vector3d towards =
                    (direction + disc.x() * east + disc.y() * north).normalized();
                // The part of the disc under the facet's own plane does not shine on it.
                if (points.normal.dot(towards) <= 0.0) continue;
                const Eigen::Vector2d place = evenly(static_cast<int>(k), start);
                rays.push_back({.origin = points.at(place.x(), place.y()),
                                .direction = towards.cast<float>()});
                owner.push_back(static_cast<std::uint32_t>(f));
            }
        }
        std::vector<std::uint8_t> blocked(rays.size());
        scene.occluded(rays, blocked, Coherence::coherent);
        for (std::size_t i = 0; i < rays.size(); ++i) fraction[owner[i]] += blocked[i] ? 0 : 1;
        for (std::size_t f = begin; f < end; ++f) {
            if (chosen[f]) fraction[f] /= static_cast<float>(samples);
        }
    });
}

}  // namespace diurna
