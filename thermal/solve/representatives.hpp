#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "thermal/solve/solve_input.hpp"
#include "thermal/solve/solve_span.hpp"

/// A heat balance of some facets that stand for all.
namespace diurna {

/// Facets that are solved, and for every facet the one of them whose temperatures it takes; a
/// facet that is solved takes its own.
struct Representatives {
    std::vector<std::uint32_t> solved;  // ascending
    std::vector<std::uint32_t> place;   // (facet) in `solved`

    bool everything() const { return solved.size() == place.size(); }
    std::size_t of(std::size_t facet) const { return solved[place[facet]]; }
};

/// The same scene of the solved facets alone: each has the sun, air and rain that it had, and sees
/// what it saw, of each facet the one that stands for it. Facets of targets have to be among the
/// solved ones. Names the whole input, which has to outlive it; its `sun`, `from` and `guess` are
/// left aside.
class SolvedPart {
 public:
    SolvedPart(const SolveInput& whole, const Representatives& representatives);
    SolvedPart(const SolvedPart&) = delete;
    SolvedPart& operator=(const SolvedPart&) = delete;
    const SolveInput& input() const { return *input_; }

 private:
    FacetSet facets_;
    FacetViews views_, sunlight_views_;
    SunExposure none_{};
    std::unique_ptr<const SolveInput> input_;
};

/// The exposure of solved facets.
SunExposure solved_part(const SunExposure& whole, const Representatives& representatives);

/// What was solved, for all facets. `end` is that of the solved ones.
void spread(const Representatives& representatives, SpanResult& result);

}  // namespace diurna
