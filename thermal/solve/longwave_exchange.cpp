#include "thermal/solve/longwave_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "thermal/solve/linearised_span.hpp"
#include "thermal/solve/periodic_newton.hpp"

namespace diurna {

namespace {

constexpr int most_sweeps = 10;
constexpr std::size_t facets_at_once = 256;
/// [W m⁻²] of longwave that is followed further: a tenth of a millikelvin, or a thousandth of the
/// largest change.
constexpr float least_change = 0.002f, least_share = 1e-3f;

/// What leaves the facets at the instants of a level, and how it changes: (facet, instant).
struct Field {
    std::size_t used;  // instants
    std::vector<float> leaving, change;
    std::vector<float> most;          // (facet) largest |change|
    std::vector<std::uint8_t> sends;  // (facet) 1 where `leaving` is not zero
    std::span<float> changes(std::size_t f) { return {change.data() + f * used, used}; }
};

/// All of the longwave anew. `change` becomes what arrives now less what did before.
void renew_all(SolveState& solve, const Level& level, Field& field) {
    const std::size_t used = field.used;
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = 0; k < used; ++k) {
            const std::size_t i = k * level.stride;
            const double sky = solve.sky[i].longwave_down;
            const float* const kelvin = solve.kelvin.data() + i * solve.facets;
            const float* const excess = solve.excess.data() + i * solve.facets;
            for (std::size_t f = begin; f < end; ++f) {
                field.leaving[f * used + k] =
                    leaving_longwave(solve.optics.emissivity[f], sky, kelvin[f], excess[f]);
            }
        }
    });
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            arriving_longwave(solve.input.views, field.leaving, f, field.changes(f));
            field.most[f] = 0.0f;
        }
        for (std::size_t k = 0; k < used; ++k) {
            float* const excess = solve.excess.data() + k * level.stride * solve.facets;
            for (std::size_t f = begin; f < end; ++f) {
                float& change = field.change[f * used + k];
                const float next = change;
                change -= excess[f];
                excess[f] = next;
                field.most[f] = std::max(field.most[f], std::abs(change));
            }
        }
    });
}

/// Warms the blocks where more than `least` has arrived, and tells what more they send. Returns the
/// largest change of temperature.
double follow(SolveState& solve, const Level& level, float least, Field& field) {
    const std::size_t used = field.used;
    std::vector<double> warmest(solve.block.size(), 0.0);
    for_each_index(
        solve.block.size(),
        [&](std::size_t b) {
            Block& block = solve.block[b];
            float most = 0.0f;
            for (const std::size_t f : block.facet) {
                most = std::max(most, field.most[f]);
                field.sends[f] = 0;
            }
            if (most < least || !block.period) return;
            const auto count = Eigen::Index(block.facet.size());
            const auto n = Eigen::Index(block.start.size() / block.stride);
            const float emissivity = solve.optics.emissivity[block.facet.front()];
            Eigen::MatrixXf heat(Eigen::Index(used), count);
            for (Eigen::Index l = 0; l < count; ++l) {
                const std::span<float> change = field.changes(block.facet[std::size_t(l)]);
                heat.col(l) = emissivity * Eigen::VectorXf::Map(change.data(), heat.rows());
            }
            LinearisedSpan day{.steep = relative_slopes(block),
                               .state = Eigen::MatrixXd::Zero(n, count),
                               .warmer = {}};
            run_linearised(solve, level, block, heat, day);
            if (solve.options.periodic) {
                const Eigen::MatrixXd start = close_period(block, day.state);
                day.warmer += follow_start(block, start);
                for (Eigen::Index m = 0; m < n; ++m) {
                    for (Eigen::Index l = 0; l < count; ++l) {
                        block.start[std::size_t(m) * block.stride + std::size_t(l)] += start(m, l);
                    }
                }
                const Kind& kind = level.kind[block.material];
                block.nudge += (kind.modes ? Eigen::MatrixXd(kind.modes->probe * start) : start)
                                   .cwiseAbs()
                                   .maxCoeff();
            }
            warm(solve, level, block, day.warmer);
            warmest[b] = day.warmer.cwiseAbs().maxCoeff();
            for (std::size_t l = 0; l < block.facet.size(); ++l) {
                const std::size_t f = block.facet[l];
                field.sends[f] = 1;
                for (std::size_t k = 0; k < used; ++k) {
                    const float t = solve.kelvin[k * level.stride * solve.facets + f];
                    field.leaving[f * used + k] =
                        4.0f * emissivity * float(stefan_boltzmann) * t * t * t *
                            float(day.warmer(Eigen::Index(k), Eigen::Index(l))) +
                        (1.0f - emissivity) * field.change[f * used + k];
                }
            }
        },
        4);
    return *std::max_element(warmest.begin(), warmest.end());
}

/// Carries what is sent beyond what was to those that see it: what arrives grows by `change`.
void pass_on(SolveState& solve, const Level& level, Field& field) {
    const FacetViews& view = solve.input.views;
    const std::size_t used = field.used;
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        std::vector<std::size_t> grown;
        for (std::size_t f = begin; f < end; ++f) {
            field.most[f] = 0.0f;
            const std::span<float> change = field.changes(f);
            bool any = false;
            const auto add = [&](std::size_t from, float factor) {
                if (!field.sends[from] || factor == 0.0f) return;
                const float* const sent = field.leaving.data() + from * used;
                if (!any) std::fill(change.begin(), change.end(), 0.0f);
                any = true;
                for (std::size_t k = 0; k < used; ++k) change[k] += factor * sent[k];
            };
            add(f, view.below[f]);
            for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
                add(index(view.others.facet[k]), view.others.factor[k]);
            }
            if (any) grown.push_back(f);
        }
        for (std::size_t k = 0; k < used; ++k) {
            float* const excess = solve.excess.data() + k * level.stride * solve.facets;
            for (const std::size_t f : grown) {
                const float change = field.change[f * used + k];
                excess[f] += change;
                field.most[f] = std::max(field.most[f], std::abs(change));
            }
        }
    });
}

}  // namespace

bool exchanging(const SolveInput& input) {
    return !input.views.others.facet.empty() ||
           std::any_of(input.views.below.begin(), input.views.below.end(),
                       [](float below) { return below > 0.0f; });
}

ExchangeChange exchange_longwave(SolveState& solve, const Level& level) {
    const std::size_t used = solve.steps() / level.stride + 1;
    Field field{.used = used,
                .leaving = std::vector<float>(used * solve.facets),
                .change = std::vector<float>(used * solve.facets),
                .most = std::vector<float>(solve.facets),
                .sends = std::vector<std::uint8_t>(solve.facets, 0)};
    ExchangeChange result;
    renew_all(solve, level, field);
    const float first = *std::max_element(field.most.begin(), field.most.end());
    result.heat = double(first);
    const float least = std::max(least_change, least_share * first);
    const auto tell_blocks = [&] {
        for (Block& block : solve.block) {
            float most = 0.0f;
            for (const std::size_t f : block.facet) most = std::max(most, field.most[f]);
            block.heat_change += double(most);
        }
    };
    tell_blocks();
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const double warmer = follow(solve, level, least, field);
        result.warmer = std::max(result.warmer, warmer);
        if (warmer == 0.0) break;
        pass_on(solve, level, field);
        tell_blocks();
    }
    return result;
}

}  // namespace diurna
