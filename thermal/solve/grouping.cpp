#include "thermal/solve/grouping.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "thermal/solve/facet_exchange.hpp"

namespace diurna {

namespace {

/// Which slice of height a facet's block may hold: of columns in modes a whole tier, of others,
/// which have one air a block, two metres of it.
std::size_t slice_of(const SolveState& solve, std::size_t f, bool modes) {
    if (solve.tiers.flat()) return 0;
    const double gap = solve.tiers.height[1] - solve.tiers.height[0];
    const double slices = modes ? 1.0 : std::ceil(gap / 2.0);
    const double within = std::min(slices - 1.0, std::floor(slices * solve.tiers.share[f]));
    return static_cast<std::size_t>(solve.tiers.low[f] * slices + within);
}

/// The way of a block's facets from their tier to the next, lanes filled up.
void tell_heights(const SolveState& solve, Block& block) {
    if (solve.tiers.flat()) return;
    for (const std::size_t f : block.facet) block.up.push_back(solve.tiers.share[f]);
    for (const double up : block.up) block.mean_up += up / double(block.up.size());
    block.up.resize(block.stride, block.up.front());
}

/// Sky view of facets that lie below others: day and night are much alike there, and what a block's
/// slopes are on the whole, by which neighbours' heat is followed, says little of them.
constexpr float under_a_roof = 0.35f;
/// Beyond this share of its own like, a facet's longwave stays with it.
constexpr float nothing_but_itself = 0.999f;

}  // namespace

std::vector<KindOf> group_by_material(SolveState& solve) {
    std::map<std::tuple<std::size_t, bool, bool>, std::size_t> place_of;
    std::vector<KindOf> kinds;
    std::map<std::tuple<std::size_t, std::size_t, bool, bool, bool, bool>, std::size_t>
        open;  // still taking facets
    for (std::size_t f = 0; f < solve.facets; ++f) {
        if (solve.is_back(f)) continue;
        const MaterialId id = solve.input.facets.material[f];
        const ThermalSurface& surface = solve.input.materials[id].thermal;
        const bool sheet = solve.has_back(f) && surface.back;
        const FilmPart part = solve.part_of(f);
        const bool sheltered =
            part.wind != 1.0f && std::holds_alternative<Louis>(surface.convection);
        const bool target = !solve.in_network.empty() && solve.in_network[f];
        const bool closed =
            !sheet && !target && seen_as_itself(solve.input.views, f) > nothing_but_itself;
        const auto [place, is_new] =
            place_of.try_emplace({index(id), closed, f >= solve.counted}, kinds.size());
        const std::size_t m = place->second;
        if (is_new) kinds.push_back({id, closed});
        const bool modes = in_modes(solve.options, surface);
        const auto [last, none] =
            open.try_emplace({m, slice_of(solve, f, modes), sheet, sheltered, target,
                              solve.input.views.sky[f] < under_a_roof},
                             0);
        if (none || solve.block[last->second].facet.size() == solve.block[last->second].stride) {
            last->second = solve.block.size();
            Block& block = solve.block.emplace_back();
            block.material = m;
            block.stride = modes ? mode_lanes : lanes;
            block.tier = solve.tiers.flat() ? 0 : solve.tiers.low[f];
            block.sheltered = sheltered;
        }
        Block& block = solve.block[last->second];
        block.facet.push_back(f);
        if (sheet) block.behind.push_back(solve.other_side[f]);
    }
    for (Block& block : solve.block) tell_heights(solve, block);
    return kinds;
}

}  // namespace diurna
