#include "terrain/visibility/reciprocity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

namespace {

constexpr double widest = 8.0;          // a facet's rays count for so many times more or less
constexpr double most_from_sky = 0.02;  // of the hemisphere, where partners see more of a facet

/// Rows of (partner, value), partners rising.
struct Rows {
    std::vector<std::uint32_t> first;  // size + 1
    std::vector<std::uint32_t> partner;
    std::vector<float> value;

    std::size_t size() const { return first.size() - 1; }
};

Rows transposed(const ViewFactors& factors) {
    const std::size_t n = factors.row.size() - 1;
    Rows rows;
    rows.first.assign(n + 1, 0);
    rows.partner.resize(factors.facet.size());
    rows.value.resize(factors.facet.size());
    for (const std::uint32_t f : factors.facet) ++rows.first[f + 1];
    for (std::size_t f = 0; f < n; ++f) rows.first[f + 1] += rows.first[f];
    std::vector<std::uint32_t> next(rows.first.begin(), rows.first.end() - 1);
    for (std::size_t f = 0; f < n; ++f) {
        for (auto k = factors.row[f]; k < factors.row[f + 1]; ++k) {
            const std::uint32_t at = next[factors.facet[k]]++;
            rows.partner[at] = static_cast<std::uint32_t>(f);
            rows.value[at] = factors.factor[k];
        }
    }
    return rows;
}

double rays_of(const FacetViews& views, std::size_t facet) {
    return views.rays.empty() ? 1.0 : views.rays[facet];
}

double hidden_from(const FacetViews& views, std::size_t facet) {
    return views.hidden.empty() ? 0.0 : double{views.hidden[facet]};
}

/// Of the hemisphere, what lies in copies' places.
double copied_seen(const FacetViews& views, std::size_t facet) {
    const ViewFactors& copied = views.copied;
    if (copied.row.empty()) return 0.0;
    double sum = 0.0;
    for (auto k = copied.row[facet]; k < copied.row[facet + 1]; ++k) sum += copied.factor[k];
    return sum;
}

/// Adds what is seen in copies' places to the rows, by rising number.
void add_copied(FacetViews& views) {
    if (views.copied.row.empty()) return;
    const ViewFactors own = std::move(views.others), copied = std::move(views.copied);
    views.copied = {};
    ViewFactors& all = views.others = {};
    all.row.push_back(0);
    for (std::size_t f = 0; f + 1 < own.row.size(); ++f) {
        auto a = own.row[f], b = copied.row[f];
        while (a < own.row[f + 1] || b < copied.row[f + 1]) {
            const bool is_own = a < own.row[f + 1];
            const bool is_copied = b < copied.row[f + 1];
            const std::uint32_t facet = !is_copied ? own.facet[a]
                                        : !is_own  ? copied.facet[b]
                                                   : std::min(own.facet[a], copied.facet[b]);
            float factor = 0.0f;
            if (is_own && own.facet[a] == facet) factor += own.factor[a++];
            if (is_copied && copied.facet[b] == facet) factor += copied.factor[b++];
            all.facet.push_back(facet);
            all.factor.push_back(factor);
        }
        all.row.push_back(static_cast<std::uint32_t>(all.facet.size()));
    }
}

/// A number in [0, 1) of a pair, whichever of the two asks.
double drawn(std::size_t a, std::size_t b) {
    return unit_interval(hashed((std::uint64_t{std::min(a, b)} << 32) | std::max(a, b)));
}

/// Rays of either facet of a pair that met the other, for all pairs that have met. Of the pairs
/// below the cut-off a few represent all.
Rows hits_of_pairs(std::span<const double> area_of, const FacetViews& views, double cut_off,
                   ReciprocityReport& report) {
    const ViewFactors& seen = views.others;
    const Rows seen_by = transposed(seen);
    Rows pairs;
    pairs.first.push_back(0);
    pairs.partner.reserve(2 * seen.facet.size());
    pairs.value.reserve(2 * seen.facet.size());
    for (std::size_t f = 0; f < area_of.size(); ++f) {
        auto a = seen.row[f];
        auto b = seen_by.first[f];
        while (a < seen.row[f + 1] || b < seen_by.first[f + 1]) {
            const auto none = static_cast<std::uint32_t>(area_of.size());
            const std::uint32_t from_a = a < seen.row[f + 1] ? seen.facet[a] : none;
            const std::uint32_t from_b = b < seen_by.first[f + 1] ? seen_by.partner[b] : none;
            const std::uint32_t partner = std::min(from_a, from_b);
            double hits = 0.0;  // both ways
            if (from_a == partner) hits += seen.factor[a++] * rays_of(views, f);
            if (from_b == partner) hits += seen_by.value[b++] * rays_of(views, partner);
            if (partner == f) continue;
            const double mine = area_of[f], theirs = area_of[partner];
            const double area =
                hits / (rays_of(views, f) / mine + rays_of(views, partner) / theirs);
            if (const double least = cut_off * std::min(mine, theirs); area < least) {
                if (drawn(f, partner) >= area / least) {
                    report.left_out += partner > f;
                    continue;
                }
                hits *= least / area;
            }
            report.pairs += partner > f;
            pairs.partner.push_back(partner);
            pairs.value.push_back(static_cast<float>(hits));
        }
        pairs.first.push_back(static_cast<std::uint32_t>(pairs.partner.size()));
    }
    return pairs;
}

/// (T31) of docs/theory.md
/// Exchange areas of pairs, hits / (density + density), by densities of rays that close the rows.
class ExchangeAreas {
 public:
    ExchangeAreas(std::span<const double> area, const FacetViews& views, const Rows& pairs)
        : area_(area),
          pairs_(pairs),
          wanted_(area.size()),
          density_(area.size()),
          least_(area.size()),
          sum_(area.size()) {
        for (std::size_t f = 0; f < area.size(); ++f) {
            const double rest = 1.0 - double{views.sky[f]} - double{views.below[f]} -
                                hidden_from(views, f) - copied_seen(views, f);
            wanted_[f] = std::max(0.0, rest) * area[f];
            density_[f] = rays_of(views, f) / area[f];
            least_[f] = density_[f] / widest;
        }
        add_up();
    }

    double of(std::size_t f, std::size_t k) const {
        return pairs_.value[k] / (density_[f] + density_[pairs_.partner[k]]);
    }

    /// Greatest share of a hemisphere by which a row misses its sum.
    double worst_row() const {
        double worst = 0.0;
        for (std::size_t f = 0; f < sum_.size(); ++f) {
            if (pairs_.first[f] == pairs_.first[f + 1]) continue;
            worst = std::max(worst, std::abs(sum_[f] - wanted_[f]) / area_[f]);
        }
        return worst;
    }

    /// Counts the rays of facets with too large rows for more, of those with too small ones for
    /// less.
    void improve() {
        for (std::size_t f = 0; f < sum_.size(); ++f) {
            if (!(sum_[f] > 0.0)) continue;
            density_[f] = std::clamp(density_[f] * sum_[f] / std::max(wanted_[f], 1e-3 * sum_[f]),
                                     least_[f], least_[f] * widest * widest);
        }
        add_up();
    }

    /// (facet) What its areas have to be multiplied with so that they do not exceed its row's sum,
    /// once the sky has given what it may.
    std::vector<double> shrink_to_fit(std::vector<float>& sky) const {
        std::vector<double> shrink(sum_.size(), 1.0);
        for (std::size_t f = 0; f < sum_.size(); ++f) {
            const double excess = (sum_[f] - wanted_[f]) / area_[f];
            if (excess <= 0.0) continue;
            const double from_sky = std::min({excess, most_from_sky, double{sky[f]}});
            sky[f] -= static_cast<float>(from_sky);
            shrink[f] = (wanted_[f] + from_sky * area_[f]) / sum_[f];
        }
        return shrink;
    }

 private:
    void add_up() {
        for_each_index(sum_.size(), [&](std::size_t f) {
            double row = 0.0;
            for (auto k = pairs_.first[f]; k < pairs_.first[f + 1]; ++k) row += of(f, k);
            sum_[f] = row;
        });
    }

    std::span<const double> area_;
    const Rows& pairs_;
    std::vector<double> wanted_;   // (facet) area that its row has to make up [m²]
    std::vector<double> density_;  // rays per area, as the rows' sums would have them
    std::vector<double> least_;    // of that
    std::vector<double> sum_;      // of its row [m²]
};

}  // namespace

ReciprocityReport make_reciprocal(const FacetSet& facets, FacetViews& views,
                                  const ReciprocityOptions& options) {
    assert(views.others.row.size() == facets.size() + 1);
    ReciprocityReport report;
    const std::size_t n = facets.size();
    // Of a net, its strips: rays to it count for what it stops.
    std::vector<double> area(facets.area.begin(), facets.area.end());
    for (std::size_t f = 0; f < n && !options.passed.empty(); ++f) {
        const PassedLight& passed = options.passed[index(facets.material[f])];
        area[f] *= std::max(1e-3, 1.0 - double{options.sunlight ? passed.sunlight : passed.heat});
    }
    const Rows pairs = hits_of_pairs(area, views, options.cut_off, report);
    ExchangeAreas areas(area, views, pairs);
    while (report.passes < options.passes && areas.worst_row() > options.closure) {
        areas.improve();
        ++report.passes;
    }
    // What still exceeds a row's sum is taken off both ways; what is missing goes to `below`,
    // of what is buried to `hidden`.
    const std::vector<float> sky = views.sky;
    const std::vector<double> shrink = areas.shrink_to_fit(views.sky);
    for (std::size_t f = 0; f < views.shares.size(); ++f) {
        if (!(views.sky[f] > 0.0f)) views.shares[f] = {};  // of rays' chance
        if (views.sky[f] == sky[f] || !(views.sky[f] > 0.0f)) continue;
        views.shares[f] =
            with_sky_view(views.shares[f], facets.normal[f], double{sky[f]}, double{views.sky[f]});
    }

    ViewFactors& factors = views.others;
    factors.row = pairs.first;
    factors.facet.resize(pairs.partner.size());
    factors.factor.resize(pairs.partner.size());
    std::vector<double> sum(n);
    for_each_index(n, [&](std::size_t f) {
        double row = 0.0;
        for (auto k = pairs.first[f]; k < pairs.first[f + 1]; ++k) {
            const std::uint32_t partner = pairs.partner[k];
            const double shared = areas.of(f, k) * std::min(shrink[f], shrink[partner]);
            factors.facet[k] = partner;
            factors.factor[k] = static_cast<float>(shared / area[f]);
            row += factors.factor[k];
        }
        sum[f] = row;
    });
    for (std::size_t f = 0; f < n; ++f) {
        const double known = sum[f] + views.sky[f] + hidden_from(views, f) + copied_seen(views, f);
        report.worst_closure =
            std::max(report.worst_closure, std::abs(1.0 - known - double{views.below[f]}));
        const float missing = std::max(0.0f, static_cast<float>(1.0 - known));
        if (!views.buried.empty() && views.buried[f]) {
            views.hidden.resize(n, 0.0f);
            views.hidden[f] = missing;
            views.below[f] = 0.0f;
        } else {
            views.below[f] = missing;
        }
    }
    views.buried.clear();
    add_copied(views);
    return report;
}

}  // namespace diurna
