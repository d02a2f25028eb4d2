#include "terrain/visibility/reciprocity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "materials/base/parallel.hpp"

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

Rows transposed(const ViewFactors& exchange) {
    const std::size_t n = exchange.row.size() - 1;
    Rows rows;
    rows.first.assign(n + 1, 0);
    rows.partner.resize(exchange.facet.size());
    rows.value.resize(exchange.facet.size());
    for (const FacetId f : exchange.facet) ++rows.first[index(f) + 1];
    for (std::size_t f = 0; f < n; ++f) rows.first[f + 1] += rows.first[f];
    std::vector<std::uint32_t> next(rows.first.begin(), rows.first.end() - 1);
    for (std::size_t f = 0; f < n; ++f) {
        for (auto k = exchange.row[f]; k < exchange.row[f + 1]; ++k) {
            const std::uint32_t at = next[index(exchange.facet[k])]++;
            rows.partner[at] = static_cast<std::uint32_t>(f);
            rows.value[at] = exchange.factor[k];
        }
    }
    return rows;
}

/// Rays of either facet of a pair that met the other, for all pairs that have met.
Rows hits_of_pairs(const FacetSet& facets, const FacetViews& view, double cut_off,
                   ReciprocityReport& report) {
    const ViewFactors& seen = view.others;
    const auto rays = [&](std::size_t f) { return view.rays.empty() ? 1.0 : view.rays[f]; };
    const Rows seen_by = transposed(seen);
    Rows pairs;
    pairs.first.push_back(0);
    pairs.partner.reserve(2 * seen.facet.size());
    pairs.value.reserve(2 * seen.facet.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        auto a = seen.row[f];
        auto b = seen_by.first[f];
        while (a < seen.row[f + 1] || b < seen_by.first[f + 1]) {
            const auto none = static_cast<std::uint32_t>(facets.size());
            const std::uint32_t from_a =
                a < seen.row[f + 1] ? static_cast<std::uint32_t>(index(seen.facet[a])) : none;
            const std::uint32_t from_b = b < seen_by.first[f + 1] ? seen_by.partner[b] : none;
            const std::uint32_t partner = std::min(from_a, from_b);
            double hits = 0.0;  // both ways
            if (from_a == partner) hits += seen.factor[a++] * rays(f);
            if (from_b == partner) hits += seen_by.value[b++] * rays(partner);
            if (partner == f) continue;
            const double mine = facets.area[f], theirs = facets.area[partner];
            const double area = hits / (rays(f) / mine + rays(partner) / theirs);
            if (area < cut_off * std::min(mine, theirs)) {
                report.left_out += partner > f;
                continue;
            }
            report.pairs += partner > f;
            pairs.partner.push_back(partner);
            pairs.value.push_back(static_cast<float>(hits));
        }
        pairs.first.push_back(static_cast<std::uint32_t>(pairs.partner.size()));
    }
    return pairs;
}

}  // namespace

ReciprocityReport make_reciprocal(const FacetSet& facets, FacetViews& view,
                                  const ReciprocityOptions& options) {
    assert(view.others.row.size() == facets.size() + 1);
    ReciprocityReport report;
    const std::size_t n = facets.size();
    const Rows pairs = hits_of_pairs(facets, view, options.cut_off, report);
    std::vector<double> wanted(n), least(n), sum(n);
    std::vector<double> density(n);  // rays per area, as the rows' sums would have them
    for (std::size_t f = 0; f < n; ++f) {
        const double rest = 1.0 - double{view.sky[f]} - view.below[f];
        wanted[f] = std::max(0.0, rest) * facets.area[f];
        density[f] = (view.rays.empty() ? 1.0 : view.rays[f]) / facets.area[f];
        least[f] = density[f] / widest;
    }
    const auto area_of = [&](std::size_t f, std::size_t k) {
        return pairs.value[k] / (density[f] + density[pairs.partner[k]]);
    };
    const auto add_up = [&] {
        for_each_index(n, [&](std::size_t f) {
            double row = 0.0;
            for (auto k = pairs.first[f]; k < pairs.first[f + 1]; ++k) row += area_of(f, k);
            sum[f] = row;
        });
    };
    for (add_up(); report.passes < options.passes; ++report.passes) {
        double worst = 0.0;
        for (std::size_t f = 0; f < n; ++f) {
            if (pairs.first[f] == pairs.first[f + 1]) continue;
            worst = std::max(worst, std::abs(sum[f] - wanted[f]) / facets.area[f]);
        }
        if (worst <= options.closure) break;
        for (std::size_t f = 0; f < n; ++f) {
            if (!(sum[f] > 0.0)) continue;
            density[f] = std::clamp(density[f] * sum[f] / std::max(wanted[f], 1e-3 * sum[f]),
                                    least[f], least[f] * widest * widest);
        }
        add_up();
    }
    // What still exceeds a row's sum is taken off both ways; what is missing goes to `below`.
    std::vector<double> shrink(n, 1.0);
    for (std::size_t f = 0; f < n; ++f) {
        const double excess = (sum[f] - wanted[f]) / facets.area[f];
        if (excess <= 0.0) continue;
        const double from_sky = std::min({excess, most_from_sky, double{view.sky[f]}});
        view.sky[f] -= static_cast<float>(from_sky);
        shrink[f] = (wanted[f] + from_sky * facets.area[f]) / sum[f];
    }

    ViewFactors& exchange = view.others;
    exchange.row = pairs.first;
    exchange.facet.resize(pairs.partner.size());
    exchange.factor.resize(pairs.partner.size());
    for_each_index(n, [&](std::size_t f) {
        double row = 0.0;
        for (auto k = pairs.first[f]; k < pairs.first[f + 1]; ++k) {
            const std::uint32_t partner = pairs.partner[k];
            const double area = area_of(f, k) * std::min(shrink[f], shrink[partner]);
            exchange.facet[k] = FacetId{partner};
            exchange.factor[k] = static_cast<float>(area / facets.area[f]);
            row += exchange.factor[k];
        }
        sum[f] = row;
    });
    for (std::size_t f = 0; f < n; ++f) {
        const double whole = sum[f] + view.sky[f] + view.below[f];
        report.worst_closure = std::max(report.worst_closure, std::abs(1.0 - whole));
        view.below[f] = std::max(0.0f, static_cast<float>(1.0 - sum[f] - view.sky[f]));
    }
    return report;
}

}  // namespace diurna
