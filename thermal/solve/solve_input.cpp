#include "thermal/solve/solve_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

SolveOptions quick(SolveOptions options, double kelvin) {
    const double share = std::min(1.0, kelvin / 0.1);
    if (!(share > 0.0)) return options;
    options.mode_error = std::max(options.mode_error, 0.03 * share);
    options.tolerance = std::max(options.tolerance, 0.02 * share);
    options.settled = std::max(options.settled, 0.05 * share);
    options.quick = share >= 0.5;
    if (!options.quick) return options;
    options.still = std::max(options.still, 0.1 * share);
    options.still_heat = std::max(options.still_heat, 0.3 * share);
    return options;
}

std::vector<Instant> step_instants(const SolveOptions& options) {
    const auto steps = std::max(1LL, std::llround(options.duration / options.step));
    std::vector<Instant> instants;
    for (long long i = 0; i <= steps; ++i) {
        instants.push_back(later(options.start, options.duration * double(i) / double(steps)));
    }
    return instants;
}

double measured_share(const SolveInput& input, MaterialId material) {
    return input.measured_share.empty() ? 0.0 : input.measured_share[index(material)];
}

double measured_albedo(const SkyState& sky, double share) {
    if (!(share > 0.0) || std::isnan(sky.albedo)) return not_measured;
    return std::min(1.0, share * sky.albedo);
}

void check(const SolveInput& input, const SolveOptions& options) {
    const std::size_t n = input.facets.size();
    if (n == 0) throw InputError("thermal solve", "the scene has no facets");
    if (!(options.step > 0.0) || !(options.duration > 0.0)) {
        throw InputError("thermal solve", "step and duration must be greater than zero");
    }
    if (input.views.sky.size() != n || input.views.below.size() != n ||
        input.views.others.row.size() != n + 1) {
        throw InputError("thermal solve", "the sky view belongs to another set of facets");
    }
    if (!input.height.empty() && input.height.size() != n) {
        throw InputError("thermal solve", "the heights belong to another set of facets");
    }
    if (!input.part.empty() && input.part.size() != n) {
        throw InputError("thermal solve", "the parts in the wind belong to another set of facets");
    }
    if (!input.open_above.empty() && input.open_above.size() != n) {
        throw InputError("thermal solve",
                         "the covers above facets belong to another set of facets");
    }
    if (!input.measured_share.empty() && input.measured_share.size() != input.materials.size()) {
        throw InputError("thermal solve",
                         "the shares of measured albedo belong to other materials");
    }
    const std::size_t instants = step_instants(options).size();
    for (std::size_t i = 0; i < input.sun.edge.size(); ++i) {
        const ShadowEdge& edge = input.sun.edge[i];
        if (edge.facet >= n || edge.step + 1 >= instants || !(edge.share >= 0.0f) ||
            edge.share > 1.0f || (i > 0 && edge.step < input.sun.edge[i - 1].step)) {
            throw InputError("thermal solve",
                             "shadow edges must be in the span, in ascending order");
        }
    }
    if (!input.sun.fraction.empty() && input.sun.fraction.size() != n * instants) {
        throw InputError("thermal solve",
                         fmt::format("sun exposure has {} values for {} facets and {} instants",
                                     input.sun.fraction.size(), n, instants));
    }
}

}  // namespace diurna
