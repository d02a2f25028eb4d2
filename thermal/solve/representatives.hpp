#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "thermal/solve/solve_input.hpp"
#include "thermal/solve/solve_span.hpp"

/// A heat balance of representative facets.
namespace diurna {

/// Facets that are solved, and for every facet the representative whose temperatures it uses; a
/// solved facet represents itself.
struct Representatives {
    std::vector<std::uint32_t> solved;  // ascending
    std::vector<std::uint32_t> place;   // (facet) index in `solved`

    bool everything() const { return solved.size() == place.size(); }
    std::size_t of(std::size_t facet) const { return solved[place[facet]]; }
};

/// Every facet is its own representative.
Representatives all_represent_themselves(std::size_t facets);

/// Patches that are solved in addition to a scene's facets: they receive light and heat from these
/// but do not affect them.
struct BesideFacets {
    FacetSet facets;                    // with their own vertices
    FacetViews views;                   // (patch) of the scene's facets
    FacetViews sunlight_views{};        // the same, if SolveInput has them
    std::vector<std::uint32_t> like{};  // (patch) scene facet whose air, wind and rain it has

    std::size_t size() const { return like.size(); }
};

/// The same scene with only the solved facets, and patches after them: each keeps its sun, air and
/// rain, and its view factors, with every facet replaced by its representative. All facets of
/// targets must be solved. Refers to the whole input, which must outlive it; its `sun` and `from`
/// are not used.
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

/// The sun exposure of so many solved facets, and of patches after them.
SunExposure with_beside(SunExposure solved, std::size_t facets, const SunExposure& beside);

/// Copies the solved results to all facets, without the last `beside` of the solved ones. `end` is
/// the state of the solved ones and these.
void spread(const Representatives& representatives, SpanResult& result, std::size_t beside = 0);

}  // namespace diurna
