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
constexpr std::size_t facets_at_once = 256;
/// [W m⁻²] of longwave that is followed further: a tenth of a millikelvin, or a thousandth of the
/// largest change.
constexpr float least_change = 0.002f, least_share = 1e-3f;

/// What facets have got to send at the instants of a level, and how what arrives changes by it:
/// (facet, instant).
struct Field {
    std::size_t used;  // instants
    std::vector<float>&leaving, &change;
    std::vector<float> most;          // (facet) largest |change|
    std::vector<std::uint8_t> sends;  // (facet) 1 where `leaving` may be large enough to send
    std::vector<float> itself;        // (facet) share of its own like that it sees
    float open = 1.0f;  // 1 − the greatest share of longwave that comes back from a facet
    /// What arrives for each W m⁻² of others', to and fro between a facet and its own like.
    float to_and_fro(std::size_t f, float reflectance) const {
        return 1.0f / std::max(0.01f, 1.0f - itself[f] * reflectance);
    }
    std::span<float> changes(std::size_t f) { return {change.data() + f * used, used}; }
    std::span<float> leaves(std::size_t f) { return {leaving.data() + f * used, used}; }
};

float largest(std::span<const float> x) {
    float most = 0.0f;
    for (const float v : x) most = std::max(most, std::abs(v));
    return most;
}

/// Carries what leaves the facets to those that see it, and on from there as they reflect it, in so
/// many sweeps or until less than `least` [W m⁻²] would be added: `change` becomes what arrives.
/// What was not sent stays in `leaving`; reports whether any of that counts.
bool send(const SolveState& solve, float least, int sweeps, Field& field) {
    constexpr std::size_t most_values = 16'000'000;  // at once
    const FacetViews& view = solve.input.views;
    const SeenRows rows{
        .row = view.others.row, .source = view.others.facet, .factor = view.others.factor};
    const std::size_t room = std::max<std::size_t>(16, most_values / solve.facets);
    const std::size_t chunks = (field.used + room - 1) / room;
    const std::size_t lanes = (field.used + chunks - 1) / chunks;
    const float scale = 1.0f / (least * field.open);
    std::vector<float> counts(solve.facets);
    std::vector<std::uint8_t> left(solve.facets, 0);
    for_each_index(solve.facets, [&](std::size_t f) {
        if (field.most[f] > 0.0f) std::fill_n(field.changes(f).begin(), field.used, 0.0f);
    });
    for (std::size_t first = 0; first < field.used; first += lanes) {
        const std::size_t count = std::min(lanes, field.used - first);
        for_each_index(solve.facets, [&](std::size_t f) {
            counts[f] =
                field.sends[f] ? scale * largest(field.leaves(f).subspan(first, count)) : 0.0f;
        });
        interreflect(
            rows,
            {.value = field.leaving.data() + first,
             .stride = field.used,
             .lanes = count,
             .counts = counts},
            [&](std::size_t f, const float* arrived, float* unsent) {
                const float reflectance = 1.0f - solve.optics.emissivity[f];
                const float all = field.to_and_fro(f, reflectance);
                float* const change = field.changes(f).data() + first;
                for (std::size_t k = 0; k < count; ++k) change[k] += all * arrived[k];
                for (std::size_t k = 0; k < count; ++k) {
                    unsent[k] += reflectance * all * arrived[k];
                }
                return f < solve.counted ? scale * largest({unsent, count}) : 0.0f;
            },
            sweeps);
        for (std::size_t f = 0; f < solve.facets; ++f) left[f] |= counts[f] > 1.0f;
    }
    field.sends.swap(left);
    return std::find(field.sends.begin(), field.sends.end(), 1) != field.sends.end();
}

/// The excess grows by `change`.
void take_in(SolveState& solve, const Level& level, Field& field) {
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        std::vector<std::size_t> grown;
        for (std::size_t f = begin; f < end; ++f) {
            field.most[f] = largest(field.changes(f));
            if (field.most[f] > 0.0f) grown.push_back(f);
        }
        for (std::size_t k = 0; k < field.used; ++k) {
            float* const excess = solve.excess.data() + k * level.stride * solve.facets;
            for (const std::size_t f : grown) excess[f] += field.change[f * field.used + k];
        }
    });
}

/// The sky's longwave at the facets' heights beyond that at the weather's, at one instant.
class SkyBeyond {
 public:
    SkyBeyond(const SolveState& solve, std::size_t i) : tiers_(solve.tiers) {
        if (tiers_.flat()) return;
        const double here = solve.sky[i].longwave_down;
        for (std::size_t tier = 0; tier < tiers_.size(); ++tier) {
            beyond_.push_back(float(solve.tier_sky[i * tiers_.size() + tier].longwave_down - here));
        }
    }
    float operator()(std::size_t f) const {
        if (beyond_.empty()) return 0.0f;
        const float* const low = &beyond_[tiers_.low[f]];
        return low[0] + tiers_.share[f] * (low[1] - low[0]);
    }

 private:
    const AirTiers& tiers_;
    std::vector<float> beyond_;  // (tier)
};

/// Recomputes all of the longwave. `change` becomes what arrives now less what did before. The sky
/// of a facet's own height stands above it: what leaves is reported beyond the sky at the weather's
/// height, what arrives beyond that at its own.
void renew_all(SolveState& solve, const Level& level, Field& field) {
    const std::size_t used = field.used;
    const bool heights = !solve.tiers.flat();
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = 0; k < used; ++k) {
            const std::size_t i = k * level.stride;
            const double sky = solve.sky[i].longwave_down;
            const SkyBeyond beyond(solve, i);
            const float* const kelvin = solve.kelvin.data() + i * solve.facets;
            const float* const excess = solve.excess.data() + i * solve.facets;
            for (std::size_t f = begin; f < end; ++f) {
                // What falls on it beyond the sky: of neighbours, of a sky that differs by height
                // and by direction.
                const double tilt =
                    solve.tilt.empty()
                        ? 0.0
                        : solve.at_facet(&SkyState::tilted_longwave, i, f) * solve.tilt[f];
                field.leaving[f * used + k] =
                    leaving_longwave(solve.optics.emissivity[f], sky, kelvin[f],
                                     excess[f] + beyond(f) + float(tilt));
            }
        }
    });
    for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            arriving_longwave(solve.input.views, field.leaving, f, field.changes(f));
        }
        for (std::size_t f = begin; f < end; ++f) field.most[f] = 0.0f;
        for (std::size_t k = 0; k < used; ++k) {
            const SkyBeyond beyond(solve, k * level.stride);
            float* const excess = solve.excess.data() + k * level.stride * solve.facets;
            for (std::size_t f = begin; f < end; ++f) {
                float& change = field.change[f * used + k];
                if (heights) {
                    change -= (1.0f - solve.input.views.sky[f]) * beyond(f);
                }
                const float next = change;
                change -= excess[f];
                excess[f] = next;
                field.most[f] = std::max(field.most[f], std::abs(change));
            }
        }
    });
}

/// Puts by for sending what is reflected of the change; what of that comes back from a facet's own
/// like is taken in at once.
void reflect(SolveState& solve, const Level& level, float least, Field& field) {
    for_each_index(solve.facets, [&](std::size_t f) {
        const float reflectance = 1.0f - solve.optics.emissivity[f];
        const float back = field.to_and_fro(f, reflectance) - 1.0f;
        for (std::size_t k = 0; back > 0.0f && k < field.used; ++k) {
            float& change = field.change[f * field.used + k];
            solve.excess[k * level.stride * solve.facets + f] += back * change;
            change += back * change;
        }
        field.most[f] *= 1.0f + back;
        field.sends[f] = f < solve.counted && reflectance * field.most[f] > least * field.open;
        for (std::size_t k = 0; k < field.used; ++k) {
            field.leaving[f * field.used + k] = reflectance * field.change[f * field.used + k];
        }
    });
}

/// Largest of what has arrived at a block's facets and their backs.
float most_of(const Block& block, const Field& field) {
    float most = 0.0f;
    for (const std::size_t f : block.facet) most = std::max(most, field.most[f]);
    for (const std::size_t f : block.behind) most = std::max(most, field.most[f]);
    return most;
}

/// What has arrived at facets, as heat that a face takes in: (instant, facet).
Eigen::MatrixXf arrived_heat(std::span<const std::size_t> facets, float emissivity, Field& field) {
    Eigen::MatrixXf heat(Eigen::Index(field.used), Eigen::Index(facets.size()));
    for (std::size_t l = 0; l < facets.size(); ++l) {
        heat.col(Eigen::Index(l)) =
            emissivity * Eigen::VectorXf::Map(field.changes(facets[l]).data(), heat.rows());
    }
    return heat;
}

/// Reports what more facets send that are warmer by so much, (instant, facet). What comes back from
/// their own like has been followed with it (left_of_slopes).
void send_more(SolveState& solve, const Level& level, std::span<const std::size_t> facets,
               const Eigen::MatrixXd& warmer, Field& field) {
    for (std::size_t l = 0; l < facets.size(); ++l) {
        const std::size_t f = facets[l];
        field.sends[f] = f < solve.counted;
        const float emissivity = solve.optics.emissivity[f];
        const float all = field.to_and_fro(f, 1.0f - emissivity);
        for (std::size_t k = 0; k < field.used; ++k) {
            const std::size_t at = k * level.stride * solve.facets + f;
            const float t = solve.kelvin[at];
            const float more = all * 4.0f * emissivity * float(stefan_boltzmann) * t * t * t *
                               float(warmer(Eigen::Index(k), Eigen::Index(l)));
            field.leaving[f * field.used + k] += more;
            solve.excess[at] += field.itself[f] * more;
        }
    }
}

/// [W m⁻² K⁻¹] on the mean of the span, of what a warmer facet sends more and gets back from its
/// own like.
double back_from_own_like(const SolveState& solve, const Level& level, std::size_t f,
                          const Field& field) {
    if (field.itself[f] == 0.0f) return 0.0;
    double mean = 0.0;
    for (std::size_t k = 0; k < field.used; ++k) {
        const double t = solve.kelvin[k * level.stride * solve.facets + f];
        mean += t * t * t / double(field.used);
    }
    const double emissivity = solve.optics.emissivity[f];
    return field.itself[f] * field.to_and_fro(f, float(1.0 - emissivity)) * 4.0 * emissivity *
           emissivity * stefan_boltzmann * mean;
}

/// What is left of facets' slopes where what they send more comes back from their own like: ground
/// below something that hides all else from it loses nothing by radiation.
Eigen::RowVectorXd left_of_slopes(const SolveState& solve, const Level& level, const Block& block,
                                  const Eigen::RowVectorXd& relative, const Field& field) {
    const double count = double(block.facet.size());
    double mean = 0.0;  // [W m⁻² K⁻¹]
    for (const std::vector<double>* slope : {&block.slope, &block.back_slope}) {
        for (const double of_all : *slope) mean -= of_all / (count * double(slope->size()));
    }
    Eigen::RowVectorXd left = Eigen::RowVectorXd::Ones(relative.size());
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        const auto lane = Eigen::Index(l);
        double back = back_from_own_like(solve, level, block.facet[l], field);
        if (!block.behind.empty()) back += back_from_own_like(solve, level, block.behind[l], field);
        if (back > 0.0) left[lane] = std::max(0.02, 1.0 - back / (mean * relative[lane]));
    }
    return left;
}

/// [W m⁻²] that warm by so much that slopes there say nothing of it: left to the block's next run.
constexpr float beyond_first_order = 2000.0f;
constexpr double usual_loss = 20.0;  // [W m⁻² K⁻¹] radiation and air together

/// Starts of facets that see mostly their own like, as water under a hull does, move by no more at
/// once: they lose next to nothing, so a lasting heat would move them to where slopes are others.
void limit_moves(const Block& block, const Field& field, Eigen::MatrixXd& start) {
    constexpr float mostly = 0.5f;
    constexpr double farthest = 8.0;  // [K]
    for (Eigen::Index l = 0; l < start.cols(); ++l) {
        if (field.itself[block.facet[std::size_t(l)]] < mostly) continue;
        const double most = start.col(l).cwiseAbs().maxCoeff();
        if (most > farthest) start.col(l) *= farthest / most;
    }
}

/// Warms the blocks where more than `least` has arrived, and reports what more they send. Returns
/// the largest change of temperature.
double follow(SolveState& solve, const Level& level, float least, Field& field) {
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
            LinearisedSpan day{.steep = relative.cwiseProduct(
                                   left_of_slopes(solve, level, block, relative, field)),
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
                BlockStates(block.change.data(), n, count,
                            Eigen::OuterStride<>(Eigen::Index(block.stride))) += day.state;
            }
            warm(solve, level, block, day.warmer,
                 block.behind.empty() ? nullptr : &day.warmer_behind);
            double warmer = day.warmer.cwiseAbs().maxCoeff();
            if (!block.behind.empty()) {
                warmer = std::max(warmer, day.warmer_behind.cwiseAbs().maxCoeff());
            }
            block.warmed += warmer;
            if (!solve.is_beside(block)) warmest[b] = warmer;
            send_more(solve, level, block.facet, day.warmer, field);
            send_more(solve, level, block.behind, day.warmer_behind, field);
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
    const std::size_t used = solve.steps() / level.stride + 1;
    std::vector<float> reflectance;
    for (const float emissivity : solve.optics.emissivity) {
        reflectance.push_back(1.0f - emissivity);
    }
    for (std::vector<float>* values : {&room.leaving, &room.change}) {
        if (values->size() == used * solve.facets) continue;  // renew_all() computes all of it
        *values = {};
        values->resize(used * solve.facets);
    }
    Field field{.used = used,
                .leaving = room.leaving,
                .change = room.change,
                .most = std::vector<float>(solve.facets),
                .sends = std::vector<std::uint8_t>(solve.facets, 0),
                .itself = std::vector<float>(solve.facets),
                .open = 1.0f - greatest_sent_on(solve.input.views,
                                                std::span(reflectance).first(solve.counted))};
    for (std::size_t f = 0; f < solve.facets; ++f) {
        field.itself[f] = seen_as_itself(solve.input.views, f);
    }
    ExchangeChange result;
    renew_all(solve, level, field);
    for (const Block& block : solve.block) {
        if (level.kind[block.material].column.surface.emissivity > 0.0) continue;
        for (const std::size_t f : block.facet) {
            field.most[f] = 0.0f;
            std::fill_n(field.changes(f).begin(), field.used, 0.0f);
        }
    }
    const float first = largest(std::span(field.most).first(solve.counted));
    result.heat = double(first);
    const float least = std::max(least_change, least_share * first);
    const auto tell_blocks = [&] {
        for (Block& block : solve.block) {
            block.heat_change += double(most_of(block, field));
        }
    };
    tell_blocks();
    reflect(solve, level, least, field);
    bool left = true;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const double warmer = follow(solve, level, least, field);
        result.warmer = std::max(result.warmer, warmer);
        if (warmer == 0.0 && !left) break;
        // What is reflected goes along with what is warmer; what is left of it then goes by itself.
        const bool all = warmer == 0.0 || sweep >= sweeps_together;
        left = send(solve, least, all ? enough_sweeps : 1, field);
        take_in(solve, level, field);
        tell_blocks();
    }
    return result;
}

}  // namespace diurna
