#include "scenes/job/run/needed_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "materials/base/units.hpp"
#include "scenes/job/run/picture_shares.hpp"

namespace diurna {

namespace {

// [K] of facets from their representative, until measured: on open ground, and where something that
// stands up may throw its shadow.
constexpr float open_ground = 3.0f, in_shadows = 15.0f;
constexpr double share_of_tolerance = 0.5;  // that represented facets may take
constexpr std::size_t most_probes = 128;

/// What ground facets of a kind have in common: material, and steps of 1/8 of the normal's parts,
/// 100 m of height and 1/10 of the sky.
using GroundKind = std::array<int, 5>;
GroundKind need_kind(const FacetSet& facets, const FacetViews& views, std::size_t f) {
    const Eigen::Vector3f& n = facets.normal[f];
    return {static_cast<int>(index(facets.material[f])),
            static_cast<int>(std::lround(8.0f * n.x())),
            static_cast<int>(std::lround(8.0f * n.y())),
            static_cast<int>(std::lround(0.01f * facets.centroid[f].z())),
            static_cast<int>(std::lround(10.0f * views.sky[f]))};
}

/// Calls body(facet, what it sees, share of its surroundings) for each facet that has a share.
template <class Body>
void each_coupled(const FacetViews& views, const std::vector<float>& share, const Body& body) {
    const ViewFactors& others = views.others;
    for (std::size_t f = 0; f < share.size(); ++f) {
        if (!(share[f] > 0.0f)) continue;
        for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
            body(f, others.facet[k], others.factor[k]);
        }
    }
}

/// Whether things that stand up take half a hundredth of what a facet sees.
bool near_structures(const FacetViews& views, const std::vector<std::uint8_t>& stands,
                     std::size_t f) {
    float seen = 0.0f;
    for (std::uint32_t k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
        if (stands[views.others.facet[k]]) seen += views.others.factor[k];
    }
    return seen > 0.005f;
}

/// Of what a target in a picture shows, each of its facets decides as much as it is of the target,
/// whose rooms and sheets carry heat within.
void share_within(const FacetSet& facets, std::span<const NetworkObject> network,
                  std::vector<float>& share) {
    for (const NetworkObject& object : network) {
        std::vector<std::uint32_t> all = object.facet;
        std::copy_if(object.back.begin(), object.back.end(), std::back_inserter(all),
                     [](std::uint32_t f) { return f != no_number; });
        double seen = 0.0, area = 0.0;
        for (const std::uint32_t f : all) {
            seen += double{share[f]};
            area += double{facets.area[f]};
        }
        for (const std::uint32_t f : all) share[f] += float(seen * double{facets.area[f]} / area);
    }
}

/// How much of a picture's heat a facet decides: what it fills of it (picture_shares), what reaches
/// it of it there if it stands up, as ground that no picture sees warms a box from below and this
/// the ground about it, and what it is of a target that does.
///
/// - stands: (facet) 1 where it is no ground
std::vector<float> decided_by(const FacetSet& facets, std::span<const FacetViews* const> views,
                              std::span<const NetworkObject> network,
                              const std::vector<std::uint8_t>& stands,
                              const std::vector<float>& seen) {
    std::vector<float> share = seen;
    share_within(facets, network, share);
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round) {
        std::vector<float> next = seen;
        for (const FacetViews* of : views) {
            std::vector<float> coupled(seen.size(), 0.0f);
            each_coupled(*of, share, [&](std::size_t f, std::size_t g, float factor) {
                if (stands[g]) coupled[g] += share[f] * factor;
            });
            for (std::size_t g = 0; g < seen.size(); ++g) {
                next[g] = std::max(next[g], seen[g] + coupled[g]);
            }
        }
        share_within(facets, network, next);
        share = std::move(next);
    }
    return share;
}

/// Which facets affect which, in pictures.
struct Coupled {
    std::vector<const FacetViews*> views;  // of each stage
    std::vector<float> share;              // (facet) of what a picture shows it decides
    std::vector<float> deviation;          // (facet) [K] by which its representative may be wrong
};

/// What a kelvin deviation [K/K], or what all that is deviation [K], of facets not `solved` makes
/// of the pictures: rms over their pixels, of the worst stage.
double weight_of(const Coupled& coupled, const std::vector<std::uint8_t>& solved, bool kelvin) {
    double worst = 0.0;
    for (const FacetViews* views : coupled.views) {
        std::vector<float> away(coupled.share.size(), 0.0f);
        each_coupled(*views, coupled.share, [&](std::size_t f, std::size_t g, float factor) {
            if (!solved[g]) away[f] += kelvin ? factor * coupled.deviation[g] : factor;
        });
        double sum = 0.0, all = 0.0;
        for (std::size_t f = 0; f < coupled.share.size(); ++f) {
            sum += double{coupled.share[f]} * double{away[f]} * double{away[f]};
            all += double{coupled.share[f]};
        }
        if (all > 0.0) worst = std::max(worst, std::sqrt(sum / std::min(all, 1.0)));
    }
    return worst;
}

/// Marks the facets with the largest effect, until what the others may be deviation is little
/// enough [K].
void add_coupled(const Coupled& coupled, const std::vector<float>& worth, double allowed,
                 std::vector<std::uint8_t>& solved) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t f = 0; f < worth.size(); ++f) {
        if (!solved[f] && worth[f] > 0.0f) order.push_back(f);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return worth[a] > worth[b]; });
    std::size_t fewest = 0, most = order.size();  // `most` are enough
    const auto with = [&](std::size_t count) {
        std::vector<std::uint8_t> marked = solved;
        for (std::size_t i = 0; i < count; ++i) marked[order[i]] = 1;
        return marked;
    };
    while (fewest < most) {
        const std::size_t middle = (fewest + most) / 2;
        if (weight_of(coupled, with(middle), true) > allowed) {
            fewest = middle + 1;
        } else {
            most = middle;
        }
    }
    solved = with(most);
}

/// What is solved for pictures before thermal coupling counts: what they show, and all that stands
/// up.
struct Marked {
    std::vector<std::uint8_t> solved, stands;  // (facet)
    std::size_t seen = 0;

    std::size_t count() const {
        return std::size_t(std::count(solved.begin(), solved.end(), std::uint8_t{1}));
    }
};

Marked marked_facets(const World& world, std::span<const NetworkObject> network,
                     const std::vector<float>& share) {
    Marked marked{.solved = seen_or_beside(world, share), .stands = {}};
    marked.seen = marked.count();
    marked.stands.assign(world.surfaces().size(), 0);
    for (std::size_t f = 0; f < marked.stands.size(); ++f) {
        if (!world.on_ground(surface_id(f))) {
            marked.stands[f] = marked.solved[f] = 1;
        }
    }
    for (const NetworkObject& object : network) {
        for (const std::uint32_t f : object.facet) marked.solved[f] = 1;
        for (const std::uint32_t f : object.back) {
            if (f != no_number) marked.solved[f] = 1;
        }
    }
    return marked;
}

/// Thermal coupling of facets in these pictures, and the effect of each there: [K] by which the
/// pictures change if another facet of its kind takes its place.
struct Worth {
    Coupled coupled;
    std::vector<float> of;  // (facet)
};

Worth worth_of(const Stages& stages, std::span<const NetworkObject> network, const Marked& marked,
               const std::vector<float>& share) {
    const FacetSet& facets = stages.scene().world.surfaces();
    Worth worth{.coupled = {.views = {},
                            .share = {},
                            .deviation = std::vector<float>(facets.size(), open_ground)},
                .of = std::vector<float>(facets.size(), 0.0f)};
    Coupled& coupled = worth.coupled;
    for (std::size_t s = 0; s < stages.size(); ++s) coupled.views.push_back(&stages.at(s).views);
    coupled.share = decided_by(facets, coupled.views, network, marked.stands, share);
    for (const FacetViews* seen : coupled.views) {
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (near_structures(*seen, marked.stands, f)) coupled.deviation[f] = in_shadows;
        }
    }
    for (const FacetViews* seen : coupled.views) {
        each_coupled(*seen, coupled.share, [&](std::size_t f, std::size_t g, float factor) {
            worth.of[g] += coupled.share[f] * factor * coupled.deviation[g];
        });
    }
    return worth;
}

/// Of the facets that are not solved, one of each kind is: that which is worth most.
///
/// Returns (facet) its representative.
std::vector<std::uint32_t> choose_kinds(const FacetSet& facets, const FacetViews& views,
                                        const std::vector<float>& worth,
                                        std::vector<std::uint8_t>& solved, NeededFacets& needed) {
    std::map<GroundKind, std::uint32_t> kinds;
    std::vector<std::uint32_t> representative(facets.size());
    std::iota(representative.begin(), representative.end(), 0u);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (solved[f]) continue;
        const auto [kind, fresh] = kinds.try_emplace(need_kind(facets, views, f), f);
        if (!fresh && worth[f] > worth[kind->second]) kind->second = f;
    }
    needed.kinds = kinds.size();
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (!solved[f]) representative[f] = kinds.at(need_kind(facets, views, f));
    }
    for (const auto& [kind, f] : kinds) solved[f] = 1;
    return representative;
}

/// Probes: evenly along the sum of what the others are worth, and a little of all.
///
/// - others: facets that have a representative or are one
void draw_probes(const std::vector<std::uint32_t>& others, const std::vector<float>& worth,
                 std::vector<std::uint32_t>& representative, std::vector<std::uint8_t>& solved,
                 NeededFacets& needed) {
    double sum = 0.0;
    for (const std::uint32_t f : others) sum += double{worth[f]};
    const double little = 0.1 * sum / double(std::max<std::size_t>(1, others.size())) + 1e-30;
    const double step =
        (sum + little * double(others.size())) / double(std::max<std::size_t>(1, most_probes));
    double along = 0.5 * step;
    for (const std::uint32_t f : others) {
        along -= double{worth[f]} + little;
        if (along > 0.0) continue;
        while (along <= 0.0) along += step;
        if (solved[f]) continue;
        const double probability = std::min(1.0, (double{worth[f]} + little) / step);
        needed.probe.push_back({f, representative[f], 1.0 / probability});
    }
    for (const NeededFacets::Probe& probe : needed.probe) {
        solved[probe.facet] = 1;
        representative[probe.facet] = probe.facet;
    }
}

Representatives numbered(const std::vector<std::uint8_t>& solved,
                         const std::vector<std::uint32_t>& representative) {
    Representatives who;
    std::vector<std::uint32_t> place(solved.size(), 0);
    for (std::uint32_t f = 0; f < solved.size(); ++f) {
        if (!solved[f]) continue;
        place[f] = static_cast<std::uint32_t>(who.solved.size());
        who.solved.push_back(f);
    }
    who.place.resize(solved.size());
    for (std::size_t f = 0; f < solved.size(); ++f) who.place[f] = place[representative[f]];
    return who;
}

}  // namespace

NeededFacets needed_facets(const Stages& stages, std::span<const NetworkObject> network,
                           double tolerance) {
    const World& world = stages.scene().world;
    const std::vector<float> share = picture_shares(stages);
    Marked marked = marked_facets(world, network, share);
    const Worth worth = worth_of(stages, network, marked, share);
    NeededFacets needed;
    needed.seen = marked.seen;
    const std::size_t before = marked.count();
    std::vector<std::uint8_t>& solved = marked.solved;
    add_coupled(worth.coupled, worth.of, share_of_tolerance * tolerance, solved);
    needed.coupled = marked.count() - before;
    needed.weight = weight_of(worth.coupled, solved, false);
    std::vector<std::uint32_t> others;
    for (std::uint32_t f = 0; f < solved.size(); ++f) {
        if (!solved[f]) others.push_back(f);
    }
    std::vector<std::uint32_t> representative =
        choose_kinds(world.surfaces(), stages.at(0).views, worth.of, solved, needed);
    draw_probes(others, worth.of, representative, solved, needed);
    needed.who = numbered(solved, representative);
    return needed;
}

namespace {

/// - facets(probe): how much it counts
template <class Facets>
double rms_of_probes(const NeededFacets& needed, const TemperatureField& field,
                     const Facets& facets) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < field.instant.size(); ++i) {
        const auto kelvin = field.at(i);
        for (const NeededFacets::Probe& probe : needed.probe) {
            const double apart = double{kelvin[probe.facet]} - double{kelvin[probe.kind]};
            sum += facets(probe) * apart * apart;
            count += facets(probe);
        }
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

double probed_difference(const NeededFacets& needed, const TemperatureField& field) {
    return rms_of_probes(needed, field, [](const NeededFacets::Probe&) { return 1.0; });
}

double represented_difference(const NeededFacets& needed, const TemperatureField& field) {
    return rms_of_probes(needed, field,
                         [](const NeededFacets::Probe& probe) { return probe.facets; });
}

double represented_weight(const Stages& stages, std::span<const NetworkObject> network,
                          const std::vector<float>& share,
                          const std::vector<std::uint8_t>& solved) {
    const Marked marked = marked_facets(stages.scene().world, network, share);
    return weight_of(worth_of(stages, network, marked, share).coupled, solved, false);
}

}  // namespace diurna
