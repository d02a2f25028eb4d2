#include "thermal/solve/shadow_edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace diurna {

namespace {

/// A facet whose edge lies in the part of a step from `low`, one of 2^level equal parts.
struct Search {
    std::uint32_t facet;
    std::uint32_t low = 0;
};

/// Edges of one step, facets ascending, seen one after the other.
class StepEdges {
 public:
    StepEdges(std::span<const ShadowEdge> edges, std::uint32_t step) {
        const auto earlier = [](const ShadowEdge& e, std::uint32_t s) { return e.step < s; };
        const auto first = std::lower_bound(edges.begin(), edges.end(), step, earlier);
        const auto last = std::lower_bound(first, edges.end(), step + 1, earlier);
        left_ = {first, last};
    }
    /// That of a facet beyond the last one asked for; null: none.
    const ShadowEdge* of(std::uint32_t facet) {
        while (!left_.empty() && left_.front().facet < facet) left_ = left_.subspan(1);
        return !left_.empty() && left_.front().facet == facet ? &left_.front() : nullptr;
    }

 private:
    std::span<const ShadowEdge> left_;
};

/// Facets whose shares differ at the ends of a step; those that the days around know, facets
/// ascending, go to `known` instead.
std::vector<Search> to_be_found(std::span<const float> before, std::span<const float> after,
                                std::uint32_t step, float least_change, const EdgesAround& around,
                                std::vector<ShadowEdge>& known) {
    std::vector<Search> found;
    StepEdges day_before(around.before, step), day_after(around.after, step);
    for (std::uint32_t f = 0; f < before.size(); ++f) {
        if (!(std::abs(after[f] - before[f]) >= least_change)) continue;
        const ShadowEdge *a = day_before.of(f), *b = day_after.of(f);
        if (a && b && std::abs(a->share - b->share) <= around.furthest) {
            known.push_back({step, f, std::lerp(a->share, b->share, float(around.share))});
        } else {
            found.push_back({.facet = f});
        }
    }
    return found;
}

/// Halves a step until its parts are short enough; returns the share of one.
double halve(SunExposure& sun, std::size_t i, const SunFractionAt& fraction_at, double tolerance,
             std::vector<Search>& found) {
    const std::size_t facets = sun.fraction.size() / sun.instant.size();
    const float* const before = sun.fraction.data() + i * facets;
    const float* const after = before + facets;
    std::vector<float> middle(facets);
    std::vector<std::uint32_t> chosen;
    const double step = seconds_between(sun.instant[i], sun.instant[i + 1]);
    double part = 1.0;
    while (part * step > tolerance) {
        part *= 0.5;
        // Facets at one place of the search share the instant that is asked for.
        std::stable_sort(found.begin(), found.end(),
                         [](const Search& a, const Search& b) { return a.low < b.low; });
        for (std::size_t k = 0; k < found.size();) {
            chosen.clear();
            std::size_t end = k;
            for (; end < found.size() && found[end].low == found[k].low; ++end) {
                chosen.push_back(found[end].facet);
            }
            const double share = (2.0 * found[k].low + 1.0) * part;
            fraction_at(later(sun.instant[i], share * step), chosen, middle);
            for (; k < end; ++k) {
                const std::uint32_t f = found[k].facet;
                const float half = 0.5f * (before[f] + after[f]);
                const bool passed = (middle[f] - half) * (after[f] - half) > 0.0f;
                found[k].low = 2 * found[k].low + (passed ? 0 : 1);
            }
        }
    }
    return part;
}

}  // namespace

void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search,
                const EdgesAround& around) {
    sun.edge.clear();
    if (sun.fraction.empty() || sun.instant.size() < 2) return;
    const std::size_t facets = sun.fraction.size() / sun.instant.size();
    const std::span<const float> fraction = sun.fraction;
    for (std::size_t i = 0; i + 1 < sun.instant.size(); ++i) {
        const std::size_t first = sun.edge.size();
        const auto step = static_cast<std::uint32_t>(i);
        std::vector<Search> found = to_be_found(fraction.subspan(i * facets, facets),
                                                fraction.subspan((i + 1) * facets, facets), step,
                                                search.least_change, around, sun.edge);
        if (!found.empty()) {
            const double part = halve(sun, i, fraction_at, search.tolerance, found);
            for (const Search& s : found) {
                sun.edge.push_back({step, s.facet, float((s.low + 0.5) * part)});
            }
        }
        std::sort(sun.edge.begin() + long(first), sun.edge.end(),
                  [](const ShadowEdge& a, const ShadowEdge& b) { return a.facet < b.facet; });
    }
}

}  // namespace diurna
