#include "scenes/run/needed_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "materials/base/units.hpp"
#include "scenes/run/picture_shares.hpp"

namespace diurna {

namespace {

constexpr double unknown_difference = 3.0;  // [K] of facets from one of their kind, until measured
constexpr double share_of_tolerance = 0.5;  // that what is stood for may take
constexpr std::size_t most_probes = 128;

/// What ground facets of a kind have in common: material, and steps of 1/8 of the normal's parts,
/// 100 m of height and 1/10 of the sky.
using Kind = std::array<int, 5>;
Kind kind_of(const FacetSet& facets, const FacetViews& views, std::size_t f) {
    const Eigen::Vector3f& n = facets.normal[f];
    return {static_cast<int>(index(facets.material[f])),
            static_cast<int>(std::lround(8.0f * n.x())),
            static_cast<int>(std::lround(8.0f * n.y())),
            static_cast<int>(std::lround(0.01f * facets.centroid[f].z())),
            static_cast<int>(std::lround(10.0f * views.sky[f]))};
}

/// Calls body(facet seen, what it sees, share of its surroundings) for each facet in a picture.
template <class Body>
void each_felt(const FacetViews& views, const std::vector<float>& share, const Body& body) {
    const ViewFactors& others = views.others;
    for (std::size_t f = 0; f < share.size(); ++f) {
        if (!(share[f] > 0.0f)) continue;
        for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
            body(f, index(others.facet[k]), others.factor[k]);
        }
    }
}

/// The rms over the pictures of the share of surroundings that is not `solved`.
double weight_of(const FacetViews& views, const std::vector<float>& share,
                 const std::vector<std::uint8_t>& solved) {
    std::vector<float> away(share.size(), 0.0f);
    each_felt(views, share, [&](std::size_t f, std::size_t g, float factor) {
        if (!solved[g]) away[f] += factor;
    });
    double sum = 0.0, all = 0.0;
    for (std::size_t f = 0; f < share.size(); ++f) {
        sum += double{share[f]} * double{away[f]} * double{away[f]};
        all += double{share[f]};
    }
    return all > 0.0 ? std::sqrt(sum / std::min(all, 1.0)) : 0.0;
}

/// Marks the facets that are felt most, until what a kelvin of the others is worth is small enough.
void add_felt(const FacetViews& views, const std::vector<float>& share,
              const std::vector<float>& felt, double allowed, std::vector<std::uint8_t>& solved) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t f = 0; f < felt.size(); ++f) {
        if (!solved[f] && felt[f] > 0.0f) order.push_back(f);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return felt[a] > felt[b]; });
    std::size_t fewest = 0, most = order.size();  // `most` are enough
    const auto with = [&](std::size_t count) {
        std::vector<std::uint8_t> marked = solved;
        for (std::size_t i = 0; i < count; ++i) marked[order[i]] = 1;
        return marked;
    };
    while (fewest < most) {
        const std::size_t middle = (fewest + most) / 2;
        if (weight_of(views, share, with(middle)) > allowed) {
            fewest = middle + 1;
        } else {
            most = middle;
        }
    }
    solved = with(most);
}

}  // namespace

NeededFacets needed_facets(const Stages& stages, std::span<const NetworkObject> network,
                           double tolerance) {
    const World& world = stages.scene().world;
    const FacetViews& views = stages.at(0).views;
    const FacetSet& facets = world.surfaces();
    const std::vector<float> share = picture_shares(stages);
    NeededFacets needed;
    std::vector<std::uint8_t> solved = seen_or_beside(world, share);
    needed.seen = std::size_t(std::count(solved.begin(), solved.end(), std::uint8_t{1}));
    const TextureLevels& levels = world.texture_levels;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::size_t solid = levels.empty() ? f : levels.origin[f];
        if (solid >= world.ground_facets) solved[f] = 1;
    }
    for (const NetworkObject& object : network) {
        for (const std::uint32_t f : object.facet) solved[f] = 1;
        for (const std::uint32_t f : object.back) {
            if (f != no_number) solved[f] = 1;
        }
    }
    std::vector<float> felt(facets.size(), 0.0f);
    each_felt(views, share,
              [&](std::size_t f, std::size_t g, float factor) { felt[g] += share[f] * factor; });
    const auto count = [&] {
        return std::size_t(std::count(solved.begin(), solved.end(), std::uint8_t{1}));
    };
    const std::size_t before = count();
    add_felt(views, share, felt, share_of_tolerance * tolerance / unknown_difference, solved);
    needed.felt = count() - before;
    needed.weight = weight_of(views, share, solved);

    // One of each kind: that which is felt most.
    std::map<Kind, std::uint32_t> kinds;
    std::vector<std::uint32_t> stands(facets.size());
    std::vector<std::uint32_t> others;
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        stands[f] = f;
        if (solved[f]) continue;
        others.push_back(f);
        const auto [kind, fresh] = kinds.try_emplace(kind_of(facets, views, f), f);
        if (!fresh && felt[f] > felt[kind->second]) kind->second = f;
    }
    needed.kinds = kinds.size();
    for (const std::uint32_t f : others) stands[f] = kinds.at(kind_of(facets, views, f));
    for (const auto& [kind, f] : kinds) solved[f] = 1;

    // Probes: evenly along the sum of what is felt of each, and a little of all.
    double sum = 0.0;
    for (const std::uint32_t f : others) sum += double{felt[f]};
    const double little = 0.1 * sum / double(std::max<std::size_t>(1, others.size())) + 1e-30;
    const double step =
        (sum + little * double(others.size())) / double(std::max<std::size_t>(1, most_probes));
    double along = 0.5 * step;
    for (const std::uint32_t f : others) {
        along -= double{felt[f]} + little;
        if (along > 0.0) continue;
        while (along <= 0.0) along += step;
        if (solved[f]) continue;
        needed.probe.push_back({f, stands[f]});
    }
    for (const NeededFacets::Probe& probe : needed.probe) {
        solved[probe.facet] = 1;
        stands[probe.facet] = probe.facet;
    }

    Representatives& who = needed.who;
    std::vector<std::uint32_t> place(facets.size(), 0);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (!solved[f]) continue;
        place[f] = static_cast<std::uint32_t>(who.solved.size());
        who.solved.push_back(f);
    }
    who.place.resize(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) who.place[f] = place[stands[f]];
    return needed;
}

double probed_difference(const NeededFacets& needed, const TemperatureField& field) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < field.instant.size(); ++i) {
        const auto kelvin = field.at(i);
        for (const NeededFacets::Probe& probe : needed.probe) {
            const double apart = double{kelvin[probe.facet]} - double{kelvin[probe.kind]};
            sum += apart * apart;
            count += 1.0;
        }
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace diurna
