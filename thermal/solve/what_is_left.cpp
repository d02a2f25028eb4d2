#include "thermal/solve/what_is_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace diurna {

namespace {

/// The facet of a block whose start has changed most.
std::size_t furthest_of(const Block& block) {
    std::size_t lane = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < block.change.size(); ++i) {
        const std::size_t of = i % block.stride;
        if (of >= block.facet.size() || !(std::abs(double(block.change[i])) > most)) {
            continue;
        }
        most = std::abs(double(block.change[i]));
        lane = of;
    }
    return block.facet[lane];
}

}  // namespace

std::string facet_name(const SolveState& solve, std::size_t facet) {
    return fmt::format("facet {} of {}", facet,
                       solve.input.materials[solve.input.facets.material[facet]].kind());
}

std::string furthest_facets(const SolveState& solve, const PointFacets& points,
                            const NetworkFacets& targets) {
    const double single = points.summary().residual, network = targets.summary().residual;
    const Block* worst = nullptr;
    for (const Block& block : solve.block) {
        if (block.facet.empty() || solve.of_target(block) || solve.is_beside(block)) continue;
        if (worst == nullptr || block.residual > worst->residual) worst = &block;
    }
    const double plain = worst == nullptr ? 0.0 : worst->residual;
    if (single > std::max(plain, network)) {
        return facet_name(solve, points.summary().worst_facet) + " (wet, snow-covered or freezing)";
    }
    if (network > plain) {
        return "a facet of a target";
    }
    if (worst == nullptr) return "";
    return facet_name(solve, furthest_of(*worst));
}

std::string what_is_left(const SolveState& solve, const PointFacets& points,
                         const NetworkFacets& targets, const SolveReport& report) {
    const SolveOptions& options = solve.options;
    // Without a periodic part, or after it, the span itself is solved.
    std::string line = fmt::format(
        "{}pass {}", options.periodic ? "repeated day, " : "whole span, ", report.passes);
    if (options.periodic) {
        line += fmt::format(": residual {:.1e} K (limit {:.0e} K)", report.periodic_residual,
                            options.tolerance);
    }
    line += fmt::format("{} error {:.2g} K (limit {:g} K)", options.periodic ? "," : ":",
                        report.estimated_error, report.limit);
    if (!options.periodic) return line;
    return fmt::format("{}, largest: {}", line, furthest_facets(solve, points, targets));
}

}  // namespace diurna
