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

}  // namespace

void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search) {
    sun.edge.clear();
    if (sun.fraction.empty() || sun.instant.size() < 2) return;
    const std::size_t facets = sun.fraction.size() / sun.instant.size();
    std::vector<std::uint8_t> chosen(facets, 0);
    std::vector<float> middle(facets, 0.0f);
    std::vector<Search> found;
    for (std::size_t i = 0; i + 1 < sun.instant.size(); ++i) {
        const float* const before = sun.fraction.data() + i * facets;
        const float* const after = before + facets;
        found.clear();
        for (std::size_t f = 0; f < facets; ++f) {
            if (std::abs(after[f] - before[f]) >= search.least_change) {
                found.push_back({.facet = std::uint32_t(f)});
            }
        }
        if (found.empty()) continue;
        const double step = seconds_between(sun.instant[i], sun.instant[i + 1]);
        double part = 1.0;
        while (part * step > search.tolerance) {
            part *= 0.5;
            // Facets at one place of the search share the instant that is asked for.
            std::stable_sort(found.begin(), found.end(),
                             [](const Search& a, const Search& b) { return a.low < b.low; });
            for (std::size_t k = 0; k < found.size();) {
                std::size_t end = k;
                for (; end < found.size() && found[end].low == found[k].low; ++end) {
                    chosen[found[end].facet] = 1;
                }
                const double share = (2.0 * found[k].low + 1.0) * part;
                fraction_at(later(sun.instant[i], share * step), chosen, middle);
                for (; k < end; ++k) {
                    const std::uint32_t f = found[k].facet;
                    chosen[f] = 0;
                    const float half = 0.5f * (before[f] + after[f]);
                    const bool passed = (middle[f] - half) * (after[f] - half) > 0.0f;
                    found[k].low = 2 * found[k].low + (passed ? 0 : 1);
                }
            }
        }
        std::sort(found.begin(), found.end(),
                  [](const Search& a, const Search& b) { return a.facet < b.facet; });
        for (const Search& s : found) {
            sun.edge.push_back(
                {.step = std::uint32_t(i), .facet = s.facet, .share = float((s.low + 0.5) * part)});
        }
    }
}

}  // namespace diurna
