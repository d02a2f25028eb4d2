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

/// Every facet is its own representative.
Representatives all_represent_themselves(std::size_t facets);

/// Patches that are solved beside a scene's facets: they receive light and heat from these and send
/// none.
struct BesideFacets {
    FacetSet facets;                    // with vertices of their own
    FacetViews views;                   // (patch) of the scene's facets
    FacetViews sunlight_views{};        // likewise, where SolveInput has them
    std::vector<std::uint32_t> like{};  // (patch) the scene's facet whose air, wind and rain it has

    std::size_t size() const { return like.size(); }
};

/// The same scene of the solved facets alone, and patches behind them: each has the sun, air and
/// rain that it had, and sees what it saw, of each facet the one that stands for it. Facets of
/// targets have to be among the solved ones. Names the whole input, which has to outlive it; its
/// `sun`, `from` and `guess` are left aside.
class SolvedPart {
 public:
    SolvedPart(const SolveInput& whole, const Representatives& representatives,
               const BesideFacets& beside = {});
    SolvedPart(const SolvedPart&) = delete;
    SolvedPart& operator=(const SolvedPart&) = delete;
    const SolveInput& input() const { return *input_; }

 private:
    FacetSet facets_;
    FacetViews views_, sunlight_views_;
    SunExposure none_{};
    std::unique_ptr<const SolveInput> input_;
};

/// The exposure of solved facets, and of patches behind them.
SunExposure solved_part(const SunExposure& whole, const Representatives& representatives,
                        const SunExposure& beside = {});

/// What was solved, for all facets, without the last `beside` of what was solved. `end` is that of
/// the solved ones and these.
void spread(const Representatives& representatives, SpanResult& result, std::size_t beside = 0);

}  // namespace diurna
