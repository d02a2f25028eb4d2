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

/// Facets whose shares differ at the ends of a step; for those that the days around tell of, facets
/// ascending, where to look first.
struct ToBeFound {
    std::vector<Search> anywhere;
    std::vector<ShadowEdge> likely;
};
ToBeFound to_be_found(std::span<const float> before, std::span<const float> after,
                      std::uint32_t step, float least_change, const EdgesAround& around) {
    ToBeFound found;
    StepEdges day_before(around.before, step), day_after(around.after, step);
    for (std::uint32_t f = 0; f < before.size(); ++f) {
        if (!(std::abs(after[f] - before[f]) >= least_change)) continue;
        const ShadowEdge *a = day_before.of(f), *b = day_after.of(f);
        if (a && b && std::abs(a->share - b->share) <= around.furthest) {
            found.likely.push_back({step, f, std::lerp(a->share, b->share, float(around.share))});
        } else {
            found.anywhere.push_back({.facet = f});
        }
    }
    return found;
}

/// One step of the exposure, and what reports whether a facet has come to its end's side at a share
/// of it.
class StepOfSun {
 public:
    StepOfSun(const SunExposure& sun, std::size_t i, const SunFractionAt& fraction_at)
        : fraction_at_(fraction_at),
          begin_(sun.instant[i]),
          step_(seconds_between(sun.instant[i], sun.instant[i + 1])),
          middle_(sun.fraction.size() / sun.instant.size()),
          before_(sun.fraction.data() + i * middle_.size()),
          after_(before_ + middle_.size()) {}

    double seconds() const { return step_; }
    void look(double share, const std::vector<std::uint32_t>& chosen) {
        fraction_at_(later(begin_, share * step_), chosen, middle_);
    }
    bool has_passed(std::uint32_t f) const {
        const float half = 0.5f * (before_[f] + after_[f]);
        return (middle_[f] - half) * (after_[f] - half) > 0.0f;
    }

 private:
    const SunFractionAt& fraction_at_;
    Instant begin_;
    double step_;  // [s]
    std::vector<float> middle_;
    const float *before_, *after_;
};

/// How often a step is halved until its parts are as short as the tolerance.
int halvings(double step, double tolerance) {
    int times = 0;
    for (double part = step; part > tolerance; part *= 0.5) ++times;
    return times;
}

/// Keeps the likely edges that lie in the part of the step where they are thought to be, and passes
/// on the others to be found.
void confirm(StepOfSun& step, int parts, ToBeFound& found) {
    std::vector<ShadowEdge>& likely = found.likely;
    const auto part_of = [&](const ShadowEdge& e) {
        return std::clamp(static_cast<int>(e.share * float(parts)), 0, parts - 1);
    };
    std::stable_sort(likely.begin(), likely.end(), [&](const ShadowEdge& a, const ShadowEdge& b) {
        return part_of(a) < part_of(b);
    });
    std::vector<std::uint8_t> holds(likely.size(), 1);
    std::vector<std::uint32_t> chosen;
    for (std::size_t k = 0; k < likely.size();) {
        const int part = part_of(likely[k]);
        const std::size_t first = k;
        chosen.clear();
        for (; k < likely.size() && part_of(likely[k]) == part; ++k) {
            chosen.push_back(likely[k].facet);
        }
        for (const int end : {part, part + 1}) {
            if (end == 0 || end == parts) continue;  // the step's own ends, known
            step.look(double(end) / parts, chosen);
            for (std::size_t m = first; m < k; ++m) {
                if (step.has_passed(likely[m].facet) != (end > part)) holds[m] = 0;
            }
        }
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < likely.size(); ++k) {
        if (holds[k]) {
            likely[kept++] = likely[k];
        } else {
            found.anywhere.push_back({.facet = likely[k].facet});
        }
    }
    likely.resize(kept);
}

/// Halves a step so often for those that may have their edge anywhere in it.
void halve(StepOfSun& step, int times, std::vector<Search>& found) {
    std::vector<std::uint32_t> chosen;
    double part = 1.0;
    for (int time = 0; time < times; ++time) {
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
            step.look((2.0 * found[k].low + 1.0) * part, chosen);
            for (; k < end; ++k) {
                found[k].low = 2 * found[k].low + (step.has_passed(found[k].facet) ? 0 : 1);
            }
        }
    }
}

}  // namespace

void find_edges(SunExposure& sun, const SunFractionAt& fraction_at, const EdgeSearch& search,
                const EdgesAround& around) {
    sun.edge.clear();
    if (sun.fraction.empty() || sun.instant.size() < 2) return;
    const std::size_t facets = sun.fraction.size() / sun.instant.size();
    const std::span<const float> fraction = sun.fraction;
    for (std::size_t i = 0; i + 1 < sun.instant.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        ToBeFound found = to_be_found(fraction.subspan(i * facets, facets),
                                      fraction.subspan((i + 1) * facets, facets), number,
                                      search.least_change, around);
        if (found.anywhere.empty() && found.likely.empty()) continue;
        StepOfSun step(sun, i, fraction_at);
        const int times = halvings(step.seconds(), search.tolerance);
        confirm(step, 1 << times, found);
        halve(step, times, found.anywhere);
        for (const Search& s : found.anywhere) {
            found.likely.push_back({number, s.facet, float((s.low + 0.5) / double(1 << times))});
        }
        std::sort(found.likely.begin(), found.likely.end(),
                  [](const ShadowEdge& a, const ShadowEdge& b) { return a.facet < b.facet; });
        sun.edge.insert(sun.edge.end(), found.likely.begin(), found.likely.end());
    }
}

}  // namespace diurna
