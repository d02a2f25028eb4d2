#include "terrain/visibility/view_factor_sampling.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "materials/base/parallel.hpp"
#include "terrain/visibility/block_rays.hpp"
#include "terrain/visibility/ground_rays.hpp"
#include "terrain/visibility/hemisphere_rays.hpp"
#include "terrain/visibility/lifted_facet.hpp"
#include "terrain/visibility/sky_basis.hpp"
#include "terrain/visibility/sky_bound.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_bound = 32;  // neighbours along Morton's curve
constexpr double lies_on = 1e-3;              // [m] nothing is between a facet and ground so near

/// One block's rows of view factors.
struct FactorRows {
    std::vector<std::uint32_t> length;  // (facet of the block)
    std::vector<std::uint32_t> facet;
    std::vector<float> factor;

    /// Appends a row from the facets that were hit, one entry each, by rising number.
    void append(std::span<BlockRays::Seen> seen, double weight) {
        std::sort(seen.begin(), seen.end());
        const std::size_t before = facet.size();
        for (std::size_t i = 0; i < seen.size();) {
            std::size_t j = i;
            double rays = 0.0;
            while (j < seen.size() && seen[j].met == seen[i].met) rays += seen[j++].share;
            facet.push_back(seen[i].met);
            factor.push_back(static_cast<float>(weight * rays));
            i = j;
        }
        length.push_back(static_cast<std::uint32_t>(facet.size() - before));
    }
};

/// Puts what is seen in copies' places behind all else, by the facets that are copied. Returns
/// where that begins.
std::size_t apart(const Copies& copies, std::span<BlockRays::Seen> seen) {
    const auto begin = std::partition(seen.begin(), seen.end(), [](const BlockRays::Seen& s) {
        return !Copies::is_copied(s.met);
    });
    std::for_each(begin, seen.end(), [&](BlockRays::Seen& s) { s.met = copies.at(s.met).facet; });
    return static_cast<std::size_t>(begin - seen.begin());
}

ViewFactors joined(const std::vector<FactorRows>& blocks, std::size_t facets) {
    ViewFactors factors;
    std::size_t entries = 0;
    for (const FactorRows& block : blocks) entries += block.facet.size();
    factors.row.reserve(facets + 1);
    factors.facet.reserve(entries);
    factors.factor.reserve(entries);
    factors.row.push_back(0);
    for (const FactorRows& block : blocks) {
        for (const std::uint32_t length : block.length) {
            factors.row.push_back(factors.row.back() + length);
        }
        factors.facet.insert(factors.facet.end(), block.facet.begin(), block.facet.end());
        factors.factor.insert(factors.factor.end(), block.factor.begin(), block.factor.end());
    }
    return factors;
}

/// Which facets from `first` on have ground above them. Empty: none.
std::vector<std::uint8_t> below_ground(const FacetSet& facets, const RayScene& scene,
                                       std::size_t first) {
    std::vector<std::uint8_t> buried(facets.size(), 0);
    for_each_block(
        facets.size() - first, facets_per_block, [&](std::size_t begin, std::size_t end) {
            std::vector<Ray> up;
            for (std::size_t f = first + begin; f < first + end; ++f) {
                const LiftedFacet lifted(facets, f);
                const Eigen::Vector3d middle =
                    lifted.corner + (lifted.to_b + lifted.to_c) / 3.0 + lies_on * lifted.normal;
                up.push_back({.origin = middle.cast<float>(),
                              .direction = Eigen::Vector3f::UnitZ(),
                              .far = std::numeric_limits<float>::infinity()});
            }
            // Through what the facet itself may stand below: a lid, a roof.
            std::vector<Hit> met(up.size());
            constexpr int most_above = 64;
            std::vector<std::size_t> open(up.size());
            std::iota(open.begin(), open.end(), std::size_t{0});
            for (int i = 0; i < most_above && !open.empty(); ++i) {
                std::vector<Ray> rays;
                for (const std::size_t k : open) rays.push_back(up[k]);
                met.resize(rays.size());
                scene.closest(rays, met);
                std::vector<std::size_t> left;
                for (std::size_t k = 0; k < open.size(); ++k) {
                    if (met[k].facet == no_facet) continue;
                    if (index(met[k].facet) < first) {
                        buried[first + begin + open[k]] = 1;
                        continue;
                    }
                    Ray& ray = up[open[k]];
                    ray.origin.z() = std::nextafter(ray.origin.z() + met[k].range * (1.0f + 1e-6f),
                                                    std::numeric_limits<float>::infinity());
                    left.push_back(open[k]);
                }
                open = std::move(left);
            }
        });
    if (std::none_of(buried.begin(), buried.end(), [](std::uint8_t b) { return b != 0; }))
        return {};
    return buried;
}

/// The open plane's, less what rays found hidden. Rays that miss the horizontal by chance count for
/// what lies just above it.
///
/// covered  Σ of what is hidden over rays of this weight
SkyShares open_shares(const Eigen::Vector3f& normal, const SkyVector& covered, double weight,
                      double sky_view) {
    const SkyVector open = open_plane(normal);
    SkyShares shares;
    for (std::size_t k = 1; k < sky_functions; ++k) {
        shares[k - 1] = static_cast<float>(double{open[k]} - weight * double{covered[k]});
    }
    return with_sky_view(shares, normal, double{open[0]} - weight * double{covered[0]}, sky_view);
}

/// Samplers of so many rays and of 2, 4 ... 64 times as many, for ground near objects.
std::vector<HemisphereRays> finer_rays(const FacetViewOptions& options) {
    std::vector<HemisphereRays> finer;
    finer.emplace_back(options.rays, options.seed);
    if (options.near_objects.empty()) return finer;
    const std::size_t levels = ray_levels(options.rays);
    for (std::size_t level = 1; level < levels; ++level) {
        finer.emplace_back(options.rays << level, options.seed);
    }
    return finer;
}

/// Rows of `from`, which may be the scene's facets.
///
/// - ground: the first so many of `from` take ground's rays, the others `object_rays`
/// - buried: (facet of `from`) 1 where no ray is cast; empty: nowhere
FacetViews sampled(const FacetSet& from, const FacetSet& facets, const RayScene& scene,
                   std::size_t ground, std::vector<std::uint8_t> buried,
                   const FacetViewOptions& options) {
    assert(options.rays > 0 && options.rays <= 65535);
    assert(options.object_rays > 0 && options.object_rays <= 65535);
    assert(options.near_objects.size() <= ground);
    const std::vector<HemisphereRays> ground_rays = finer_rays(options);
    const HemisphereRays object_rays(options.object_rays, options.seed);
    const SkyBound bound(facets, scene.copies());

    FacetViews views;
    views.buried = std::move(buried);
    views.rays.resize(from.size());
    views.sky.resize(from.size());
    views.below.resize(from.size());
    views.hidden.resize(from.size());
    views.shares.resize(from.size());
    std::vector<FactorRows> blocks((from.size() + facets_per_block - 1) / facets_per_block);
    std::vector<FactorRows> copied(scene.copies().empty() ? 0 : blocks.size());

    for_each_block(from.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        RayPacket rays;
        OpenAbove open;
        BlockRays found(scene, facets, options.first_object, options.others, options.sunlight);
        SkyBound::Sines sines = SkyBound::unknown;
        std::array<std::size_t, facets_per_block> level{};
        if (begin < options.near_objects.size()) {
            const std::size_t last = std::min(end, options.near_objects.size());
            BlockRays first(scene, facets, options.first_object, false, options.sunlight);
            for (std::size_t f = begin; f < last; ++f) {
                if (!options.near_objects[f]) continue;
                const bool known = options.open_above && options.open_above(f, open);
                for (std::size_t p = 0; p < ground_rays[0].packets(); ++p) {
                    ground_rays[0].fill(from, f, p, rays);
                    first.trace(rays, ground_rays[0].lanes(p),
                                static_cast<std::uint32_t>(f - begin), SkyBound::unknown,
                                known ? &open : nullptr);
                }
            }
            first.finish();
            for (std::size_t f = begin; f < last; ++f) {
                if (!options.near_objects[f]) continue;
                level[f - begin] = finer_level(
                    1.0 - (first.sky[f - begin] + first.below[f - begin]) / options.rays,
                    from.area[f], ground_rays.size());
            }
        }
        for (std::size_t f = begin; f < end; ++f) {
            if ((f - begin) % facets_per_bound == 0) {
                sines = bound.sines(from, f, std::min(end, f + facets_per_bound));
            }
            const HemisphereRays& sampler =
                f < ground ? ground_rays[level[f - begin]] : object_rays;
            views.rays[f] = static_cast<std::uint16_t>(sampler.rays());
            if (!views.buried.empty() && views.buried[f]) continue;
            const bool known = f < ground && options.open_above && options.open_above(f, open);
            for (std::size_t p = 0; p < sampler.packets(); ++p) {
                sampler.fill(from, f, p, rays);
                found.trace(rays, sampler.lanes(p), static_cast<std::uint32_t>(f - begin), sines,
                            known ? &open : nullptr);
            }
        }
        found.finish();
        std::size_t hit = 0;
        for (std::size_t f = begin; f < end; ++f) {
            const std::size_t first = hit;
            while (hit < found.owner.size() && found.owner[hit] == f - begin) ++hit;
            // (T30) of docs/theory.md
            const double weight = 1.0 / views.rays[f];
            const std::span seen = std::span(found.seen).subspan(first, hit - first);
            const std::size_t own = copied.empty() ? seen.size() : apart(scene.copies(), seen);
            blocks[begin / facets_per_block].append(seen.first(own), weight);
            if (!copied.empty()) {
                copied[begin / facets_per_block].append(seen.subspan(own), weight);
            }
            views.sky[f] = static_cast<float>(weight * found.sky[f - begin]);
            views.below[f] = static_cast<float>(weight * found.below[f - begin]);
            views.hidden[f] = static_cast<float>(weight * found.hidden[f - begin]);
            if (!views.buried.empty() && views.buried[f]) {
                views.shares[f] = {};
                continue;
            }
            views.shares[f] =
                open_shares(from.normal[f], found.covered[f - begin], weight, double{views.sky[f]});
        }
    });
    views.others = joined(blocks, from.size());
    if (!copied.empty()) views.copied = joined(copied, from.size());
    if (std::all_of(views.hidden.begin(), views.hidden.end(), [](float h) { return h == 0.0f; })) {
        views.hidden.clear();
    }
    return views;
}

}  // namespace

FacetViews facet_views(const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options) {
    std::vector<std::uint8_t> buried;
    if (options.first_object < facets.size()) {
        buried = below_ground(facets, scene, options.first_object);
    }
    return sampled(facets, facets, scene, std::min(options.first_object, facets.size()),
                   std::move(buried), options);
}

FacetViews patch_views(const FacetSet& patches, const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options) {
    return sampled(patches, facets, scene, 0, {}, options);
}

}  // namespace diurna
