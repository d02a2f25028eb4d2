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
        if (of >= block.facet.size() || !(std::abs(block.change[i]) > most)) continue;
        most = std::abs(block.change[i]);
        lane = of;
    }
    return block.facet[lane];
}

/// What is furthest from a repeated span.
std::string furthest_facets(const SolveState& solve, const PointFacets& points,
                            const NetworkFacets& targets) {
    const double single = points.summary().residual, network = targets.summary().residual;
    const Block* worst = nullptr;
    for (const Block& block : solve.block) {
        if (solve.of_target(block) || block.facet.empty()) continue;
        if (worst == nullptr || block.residual > worst->residual) worst = &block;
    }
    const double plain = worst == nullptr ? 0.0 : worst->residual;
    if (single > std::max(plain, network)) {
        return fmt::format(
            "the furthest_facets among the {} facets of water, snow or freezing ground",
            points.size());
    }
    if (network > plain) {
        return fmt::format("the furthest_facets among the {} facets of targets",
                           targets.summary().facets);
    }
    if (worst == nullptr) return "";
    const std::size_t facet = furthest_of(*worst);
    return fmt::format("the furthest_facets is facet {} of {}", facet,
                       solve.input.materials[solve.input.facets.material[facet]].kind());
}

}  // namespace

std::string what_is_left(const SolveState& solve, const PointFacets& points,
                         const NetworkFacets& targets, const SolveReport& report) {
    const SolveOptions& options = solve.options;
    std::string told = fmt::format("pass {}", report.passes);
    if (options.periodic) {
        told += fmt::format(": {:.1e} K from a repeated span ({:.0e} will do)",
                            report.periodic_residual, options.tolerance);
    }
    told += fmt::format(", neighbours worth {:.1e} K ({:.0e})", report.estimated_error,
                        options.settled);
    if (!options.periodic) return told;
    return fmt::format("{}, {}", told, furthest_facets(solve, points, targets));
}

}  // namespace diurna
