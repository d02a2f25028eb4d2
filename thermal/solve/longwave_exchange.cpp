#include "thermal/solve/longwave_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/visibility/interreflection.hpp"
#include "thermal/solve/linearised_span.hpp"
#include "thermal/solve/periodic_newton.hpp"

namespace diurna {

namespace {

constexpr int most_sweeps = 10, sweeps_together = 3;
/// [W m⁻²] of longwave that is followed further: a tenth of a millikelvin, or a thousandth of the
/// largest change.
constexpr float least_change = 0.002f, least_share = 1e-3f;
/// The same of a quick solve.
constexpr float least_quick_change = 0.02f, least_quick_share = 3e-3f;

/// Largest of what has arrived at a block's facets and their backs.
float most_of(const Block& block, const MovedLongwave& field) {
    float most = 0.0f;
    for (const std::size_t f : block.facet) most = std::max(most, field.most[f]);
    for (const std::size_t f : block.behind) most = std::max(most, field.most[f]);
    return most;
}

/// What has arrived at facets, as heat that a face takes in: (instant of the level, facet).
Eigen::MatrixXf arrived_heat(std::span<const std::size_t> facets, float emissivity,
                             const MovedLongwave& field) {
    Eigen::MatrixXf heat(Eigen::Index(field.used), Eigen::Index(facets.size()));
    for (std::size_t l = 0; l < facets.size(); ++l) {
        field.moved().get(facets[l], heat.col(Eigen::Index(l)).data());
    }
    heat *= emissivity;
    if (field.apart == 1) return heat;
    const auto apart = Eigen::Index(field.apart);
    Eigen::MatrixXf between(apart * (heat.rows() - 1) + 1, heat.cols());
    for (Eigen::Index k = 0; k < between.rows(); ++k) {
        const Eigen::Index at = k / apart, next = std::min(at + 1, heat.rows() - 1);
        const float share = float(k % apart) / float(apart);
        between.row(k) = heat.row(at) + share * (heat.row(next) - heat.row(at));
    }
    return between;
}

/// Makes of what has arrived at facets what leaves them: what they reflect of it, and what they
/// send more that are warmer by so much, (instant of the level, facet). What comes back from their
/// own like has been followed with it (left_of_slopes).
///
/// - own: (place in `facets`) 0: another block does so; empty: all 1
void send_more(SolveState& solve, std::span<const std::size_t> facets,
               const Eigen::MatrixXd& warmer, std::span<const std::uint8_t> own,
               MovedLongwave& field) {
    std::vector<float> all(solve.kelvin.slots()), kelvin(field.used);
    for (std::size_t l = 0; l < facets.size(); ++l) {
        if (!own.empty() && own[l] == 0) continue;
        const std::size_t f = facets[l];
        const float emissivity = solve.optics.emissivity[f], itself = field.itself[f];
        const float to_and_fro = field.to_and_fro(f, 1.0f - emissivity);
        field.kelvin_of(solve, f, 0, all, kelvin);
        const bool back = field.is_back(f);
        for (std::size_t run = 0; run < field.moved().runs(); ++run) {
            float more[PackedField::run], leaving[PackedField::run];
            const std::size_t width = field.moved().width(run);
            for (std::size_t k = 0; k < width; ++k) {
                const std::size_t slot = run * PackedField::run + k;
                const auto row = Eigen::Index(slot * field.apart);
                const float t = kelvin[slot];
                more[k] = to_and_fro * 4.0f * emissivity * float(stefan_boltzmann) * t * t * t *
                          float(warmer(row, Eigen::Index(l)));
            }
            if (back) {
                field.of_back.put(run, field.back[f], more);
            } else {
                leaving_of(solve, field, run, f, leaving);
                for (std::size_t k = 0; k < width; ++k) leaving[k] += more[k];
                field.moved().put(run, f, leaving);
            }
            if (itself == 0.0f) continue;
            for (std::size_t k = 0; k < width; ++k) more[k] *= itself;
            add_to(solve.excess, run, f, more);
        }
        field.sends[f] = f < solve.counted;
        if (!back) field.leaves[f] = 1;
    }
}

/// [W m⁻² K⁻¹] on the mean of the span, of what a warmer facet sends more and gets back from its
/// own like.
double back_from_own_like(const SolveState& solve, std::size_t f, const MovedLongwave& field) {
    if (field.itself[f] == 0.0f) return 0.0;
    double mean = 0.0;
    std::vector<float> kelvin(solve.kelvin.slots());
    solve.kelvin.get(f, kelvin.data());
    for (const double t : kelvin) mean += t * t * t / double(kelvin.size());
    const double emissivity = solve.optics.emissivity[f];
    return field.itself[f] * field.to_and_fro(f, float(1.0 - emissivity)) * 4.0 * emissivity *
           emissivity * stefan_boltzmann * mean;
}

/// What is left of facets' slopes where what they send more comes back from their own like: ground
/// below something that hides all else from it loses nothing by radiation.
Eigen::RowVectorXd left_of_slopes(const SolveState& solve, const Block& block,
                                  const Eigen::RowVectorXd& relative, const MovedLongwave& field) {
    const double count = double(block.facet.size());
    double mean = 0.0;  // [W m⁻² K⁻¹]
    for (const std::vector<double>* slope : {&block.slope, &block.back_slope}) {
        for (const double of_all : *slope) mean -= of_all / (count * double(slope->size()));
    }
    Eigen::RowVectorXd left = Eigen::RowVectorXd::Ones(relative.size());
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        const auto lane = Eigen::Index(l);
        double back = back_from_own_like(solve, block.facet[l], field);
        if (!block.behind.empty()) back += back_from_own_like(solve, block.behind[l], field);
        if (back > 0.0) left[lane] = std::max(0.02, 1.0 - back / (mean * relative[lane]));
    }
    return left;
}

/// [W m⁻²] that warm by so much that slopes there say nothing of it: left to the block's next run.
constexpr float beyond_first_order = 2000.0f;
constexpr double usual_loss = 20.0;  // [W m⁻² K⁻¹] radiation and air together

/// Starts of facets that see mostly their own like, as water under a hull does, move by no more at
/// once: they lose next to nothing, so a lasting heat would move them to where slopes are others.
void limit_moves(const Block& block, const MovedLongwave& field, Eigen::MatrixXd& start) {
    constexpr float mostly = 0.5f;
    constexpr double farthest = 8.0;  // [K]
    for (Eigen::Index l = 0; l < start.cols(); ++l) {
        if (field.itself[block.facet[std::size_t(l)]] < mostly) continue;
        const double most = start.col(l).cwiseAbs().maxCoeff();
        if (most > farthest) start.col(l) *= farthest / most;
    }
}

/// What leaves backs has a place of its own.
void number_backs(const SolveState& solve, MovedLongwave& field) {
    if (solve.other_side.empty()) return;
    field.back.assign(solve.facets, MovedLongwave::no_back);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < solve.facets; ++f) {
        if (solve.is_back(f)) field.back[f] = count++;
    }
    field.of_back = PackedField::of_steps(field.used, 1, count);
}

/// Warms the blocks where more than `least` has arrived, and reports what more they send. Returns
/// the largest change of temperature.
double follow(SolveState& solve, const Level& level, float least, MovedLongwave& field) {
    std::vector<double> warmest(solve.block.size(), 0.0);
    for_each_index(
        solve.block.size(),
        [&](std::size_t b) {
            Block& block = solve.block[b];
            if (!block.has_run() || solve.of_target(block)) return;
            const float most = most_of(block, field);
            if (most < least || most > beyond_first_order) {
                block.unfollowed += double(most);
                if (most > beyond_first_order && !solve.is_beside(block)) {
                    warmest[b] = double(most) / usual_loss;
                }
                return;
            }
            const auto count = Eigen::Index(block.facet.size());
            const auto n = Eigen::Index(block.start.size() / block.stride);
            const Eigen::MatrixXf heat =
                arrived_heat(block.facet, solve.optics.emissivity[block.facet.front()], field);
            const Eigen::RowVectorXd relative = relative_slopes(block);
            LinearisedSpan day{
                .steep = relative.cwiseProduct(left_of_slopes(solve, block, relative, field)),
                .state = Eigen::MatrixXd::Zero(n, count),
                .warmer = {}};
            if (!block.behind.empty()) {
                day.behind = arrived_heat(block.behind,
                                          solve.optics.emissivity[block.behind.front()], field);
            }
            run_linearised(solve, level, block, heat, day);
            if (solve.options.periodic) {
                Eigen::MatrixXd start = close_period(block, day.steep, day.state);
                limit_moves(block, field, start);
                const Eigen::MatrixXd follow = follow_start(block, day.steep, start);
                day.warmer += follow;
                if (!block.behind.empty()) day.warmer_behind += follow;
                for (Eigen::Index m = 0; m < n; ++m) {
                    for (Eigen::Index l = 0; l < count; ++l) {
                        block.start[std::size_t(m) * block.stride + std::size_t(l)] += start(m, l);
                    }
                }
                const Kind& kind = level.kind[block.material];
                block.nudge += (kind.modes ? Eigen::MatrixXd(kind.modes->probe * start) : start)
                                   .cwiseAbs()
                                   .maxCoeff();
            } else {
                BlockChanges(block.change.data(), n, count,
                             Eigen::OuterStride<>(Eigen::Index(block.stride))) +=
                    day.state.cast<float>();
            }
            warm(solve, block, day.warmer, block.behind.empty() ? nullptr : &day.warmer_behind);
            double warmer = day.warmer.cwiseAbs().maxCoeff();
            if (!block.behind.empty()) {
                warmer = std::max(warmer, day.warmer_behind.cwiseAbs().maxCoeff());
            }
            block.warmed += warmer;
            if (!solve.is_beside(block)) warmest[b] = warmer;
            std::vector<std::uint8_t> own;
            for (std::size_t l = 0; l < block.behind.size(); ++l) {
                own.push_back(solve.other_side[block.behind[l]] == block.facet[l]);
            }
            send_more(solve, block.facet, day.warmer, {}, field);
            send_more(solve, block.behind, day.warmer_behind, own, field);
        },
        4);
    return *std::max_element(warmest.begin(), warmest.end());
}

}  // namespace

bool exchanging(const SolveInput& input) {
    return !input.views.others.facet.empty() ||
           std::any_of(input.views.below.begin(), input.views.below.end(),
                       [](float below) { return below > 0.0f; });
}

ExchangeChange exchange_longwave(SolveState& solve, const Level& level, ExchangeRoom& room) {
    const std::size_t used = solve.excess.slots();
    std::vector<float> reflectance;
    for (const float emissivity : solve.optics.emissivity) {
        reflectance.push_back(1.0f - emissivity);
    }
    if (room.moved.slots() != used) {  // recompute_longwave() computes all of it
        room.moved = PackedField::of_steps(used, 1, solve.facets);
    }
    MovedLongwave field{
        .room = room,
        .used = used,
        .apart = std::max<std::size_t>(1, solve.excess.stride() / level.stride),
        .most = std::vector<float>(solve.facets),
        .sends = std::vector<std::uint8_t>(solve.facets, 0),
        .itself = std::vector<float>(solve.facets),
        .leaves = std::vector<std::uint8_t>(solve.facets, 0),
        .back = {},
        .open = 1.0f -
                greatest_sent_on(solve.input.views, std::span(reflectance).first(solve.counted))};
    for (std::size_t f = 0; f < solve.facets; ++f) {
        field.itself[f] = seen_as_itself(solve.input.views, f);
    }
    number_backs(solve, field);
    ExchangeChange result;
    recompute_longwave(solve, level, field);
    for (const Block& block : solve.block) {
        if (level.kind[block.material].column.surface.emissivity > 0.0) continue;
        for (const std::size_t f : block.facet) {
            field.most[f] = 0.0f;
            field.moved().fill(f, 0.0f);
        }
    }
    const float first = largest(std::span(field.most).first(solve.counted));
    result.heat = double(first);
    const bool quick = solve.options.quick;
    const float least = std::max(quick ? least_quick_change : least_change,
                                 (quick ? least_quick_share : least_share) * first);
    const auto tell_blocks = [&] {
        for (Block& block : solve.block) {
            block.heat_change += double(most_of(block, field));
        }
    };
    tell_blocks();
    reflect_longwave(solve, least, field);
    bool left = true;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const double warmer = follow(solve, level, least, field);
        result.warmer = std::max(result.warmer, warmer);
        if (warmer == 0.0 && !left) break;
        // What is reflected goes along with what is warmer; what is left of it then goes by itself.
        const bool all = warmer == 0.0 || sweep >= sweeps_together;
        left = send_longwave(solve, least, all ? enough_sweeps : 1, field);
        tell_blocks();
    }
    return result;
}

}  // namespace diurna
