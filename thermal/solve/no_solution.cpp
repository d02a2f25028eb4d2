#include "thermal/solve/no_solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diurna {

namespace {

const std::string failed = "the heat balance failed: ";

std::string reported(const SolveState& solve, std::size_t facet, Instant when,
                     const std::string& what) {
    return fmt::format("facet {} of {} at {}: {}", facet,
                       solve.input.materials[solve.input.facets.material[facet]].kind(),
                       format_instant(when), what);
}

/// Of the first temperature for which `good`, which holds between any two for which it holds, does
/// not; "" where it holds for all.
template <class Good>
std::string first_bad(const SolveState& solve, const Good& good) {
    const PackedField::Extremes all = solve.kelvin.extremes(solve.facets);
    if (good(all.least) && good(all.greatest)) return "";
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        const PackedField::Row row = solve.kelvin.row(i);
        for (std::size_t f = 0; f < solve.facets; ++f) {
            const float kelvin = row(f);
            if (good(kelvin)) continue;
            const std::string found = std::isfinite(kelvin)
                                          ? fmt::format("the last value is {:g} K", kelvin)
                                          : "there is no value";
            return reported(solve, f, solve.instant[i],
                            "the balance has no solution from 1 to 5000 K; " + found);
        }
    }
    return "";
}

bool is_within(float kelvin) {
    constexpr float coldest = 1.001f, hottest = 4999.9f;  // [K] the ends of what is looked at
    return kelvin > coldest && kelvin < hottest;          // false of no number
}

}  // namespace

void check_mean_balance(const SolveState& solve) {
    const std::string bad = first_bad(solve, is_within);
    if (!bad.empty()) throw std::runtime_error(failed + bad + " (means of the span)");
}

void check_numbers(const SolveState& solve) {
    // What is not finite makes its whole run so.
    bool finite = true;
    for (std::size_t i = 0; i < solve.instant.size(); i += PackedField::run) {
        const PackedField::Row row = solve.kelvin.row(i);
        for (std::size_t f = 0; f < solve.facets; ++f) finite = finite && std::isfinite(row(f));
    }
    if (finite) return;
    const std::string bad = first_bad(solve, [](float kelvin) { return std::isfinite(kelvin); });
    if (!bad.empty()) throw std::runtime_error(failed + bad);
}

std::string without_solution(const SolveState& solve, const PointFacets::Summary& points,
                             const NetworkFacets::Summary& targets) {
    std::string bad = first_bad(solve, is_within);
    if (!bad.empty()) return bad;
    if (targets.limited > 0) {
        return fmt::format("target {}: {} of its stages have no solution from 1 to 5000 K",
                           targets.first_limited, targets.limited);
    }
    if (points.unsolved == 0) return "";
    return reported(
        solve, points.first_unsolved_facet, points.first_unsolved,
        fmt::format("no step length gives a solution ({} such cases in total)", points.unsolved));
}

}  // namespace diurna
