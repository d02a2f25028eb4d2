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

/// What arrives at facets and what they send on, at the instants of a level. Between the steps of
/// the exchange a facet has one or the other, in `moved`: what has arrived in the last step, until
/// follow() makes of it what leaves.
struct Field {
    ExchangeRoom& room;
    std::size_t used;                  // instants
    std::vector<float> most;           // (facet) largest of what has arrived
    std::vector<std::uint8_t> sends;   // (facet) 1 where what leaves may be large enough to send
    std::vector<float> itself;         // (facet) share of its own like that it sees
    std::vector<std::uint8_t> leaves;  // (facet) 1 where `moved` is what leaves
    std::vector<std::uint32_t> back;   // (facet) place in `of_back` of backs; empty: no backs
    PackedField of_back{};             // what more leaves backs, which two blocks may read
    bool unsent = true;                // what has arrived is still to be reflected
    float open = 1.0f;  // 1 − the greatest share of longwave that comes back from a facet
    /// What arrives for each W m⁻² of others', to and fro between a facet and its own like.
    float to_and_fro(std::size_t f, float reflectance) const {
        return 1.0f / std::max(0.01f, 1.0f - itself[f] * reflectance);
    }
    PackedField& moved() { return room.moved; }
    const PackedField& moved() const { return room.moved; }
    bool is_back(std::size_t f) const { return !back.empty() && back[f] != no_back; }
    static constexpr std::uint32_t no_back = 0xFFFFFFFFu;
};

float largest(std::span<const float> x) {
    float most = 0.0f;
    for (const float v : x) most = std::max(most, std::abs(v));
    return most;
}

/// What leaves a facet in a run of instants.
void leaving_of(const SolveState& solve, const Field& field, std::size_t run, std::size_t f,
                float* out) {
    const std::size_t width = field.moved().width(run);
    const float share = field.leaves[f] ? 1.0f
                        : field.unsent  ? 1.0f - solve.optics.emissivity[f]
                                        : 0.0f;
    if (share > 0.0f) {
        field.moved().get(run, f, out);
        for (std::size_t k = 0; k < width; ++k) out[k] *= share;
    } else {
        std::fill_n(out, width, 0.0f);
    }
    if (!field.is_back(f)) return;
    float more[PackedField::run];
    field.of_back.get(run, field.back[f], more);
    for (std::size_t k = 0; k < width; ++k) out[k] += more[k];
}

/// Adds to a facet's values in a run of instants.
void add_to(PackedField& values, std::size_t run, std::size_t f, const float* more) {
    float sum[PackedField::run];
    values.get(run, f, sum);
    for (std::size_t k = 0; k < values.width(run); ++k) sum[k] += more[k];
    values.put(run, f, sum);
}

/// Carries what leaves the facets to those that see it, and on from there as they reflect it, in so
/// many sweeps or until less than `least` [W m⁻²] would be added: `moved` becomes what arrives, and
/// the excess grows by it. Reports whether any is left to be reflected that counts.
bool send(SolveState& solve, float least, int sweeps, Field& field) {
    const FacetViews& view = solve.input.views;
    const SeenRows rows{
        .row = view.others.row, .source = view.others.facet, .factor = view.others.factor};
    const float scale = 1.0f / (least * field.open), nothing[PackedField::run] = {};
    std::vector<float> counts(solve.facets), most(solve.facets, 0.0f);
    std::vector<std::uint8_t> left(solve.facets, 0);
    std::vector<float>& leaving = field.room.leaving;
    for (std::size_t run = 0; run < field.moved().runs(); ++run) {
        const std::size_t width = field.moved().width(run);
        leaving.resize(solve.facets * width);
        for_each_index(solve.facets, [&](std::size_t f) {
            float* const out = leaving.data() + f * width;
            leaving_of(solve, field, run, f, out);
            field.moved().put(run, f, nothing);
            counts[f] = field.sends[f] ? scale * largest({out, width}) : 0.0f;
        });
        interreflect(
            rows, {.value = leaving.data(), .stride = width, .lanes = width, .counts = counts},
            [&](std::size_t f, const float* now, float* unsent) {
                const float reflectance = 1.0f - solve.optics.emissivity[f];
                const float all = field.to_and_fro(f, reflectance);
                float more[PackedField::run];
                for (std::size_t k = 0; k < width; ++k) {
                    more[k] = all * now[k];
                    unsent[k] += reflectance * more[k];
                }
                add_to(field.moved(), run, f, more);
                return f < solve.counted ? scale * largest({unsent, width}) : 0.0f;
            },
            sweeps);
        for_each_index(solve.facets, [&](std::size_t f) {
            float sum[PackedField::run];
            field.moved().get(run, f, sum);
            const float of_run = largest({sum, width});
            left[f] |= counts[f] > 1.0f;
            most[f] = std::max(most[f], of_run);
            if (of_run > 0.0f) add_to(solve.excess, run, f, sum);
        });
    }
    field.most.swap(most);
    field.sends.swap(left);
    std::fill(field.leaves.begin(), field.leaves.end(), std::uint8_t{0});
    for (std::size_t b = 0; b < field.of_back.facets(); ++b) field.of_back.fill(b, 0.0f);
    const bool any = std::find(field.sends.begin(), field.sends.end(), 1) != field.sends.end();
    field.unsent = any;
    return any;
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

/// Recomputes all of the longwave, a run of instants after the other. `moved` becomes what arrives
/// now less what did before; nothing where that is within a step of how it is stored. The sky of a
/// facet's own height stands above it: what leaves is reported beyond the sky at the weather's
/// height, what arrives beyond that at its own.
void renew_all(SolveState& solve, const Level& level, Field& field) {
    const bool heights = !solve.tiers.flat();
    std::vector<float>& leaving = field.room.leaving;
    for (std::size_t run = 0; run < field.moved().runs(); ++run) {
        const std::size_t width = field.moved().width(run), first = run * PackedField::run;
        std::vector<SkyBeyond> beyond;
        for (std::size_t k = 0; k < width; ++k) {
            beyond.emplace_back(solve, (first + k) * level.stride);
        }
        leaving.resize(solve.facets * width);
        for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            float kelvin[PackedField::run], excess[PackedField::run];
            for (std::size_t f = begin; f < end; ++f) {
                solve.kelvin.get(run, f, kelvin);
                solve.excess.get(run, f, excess);
                for (std::size_t k = 0; k < width; ++k) {
                    const std::size_t i = (first + k) * level.stride;
                    // What falls on it beyond the sky: of neighbours, of a sky that differs by
                    // height and by direction.
                    const double tilt =
                        solve.tilt.empty()
                            ? 0.0
                            : solve.at_facet(&SkyState::tilted_longwave, i, f) * solve.tilt[f];
                    leaving[f * width + k] =
                        leaving_longwave(solve.optics.emissivity[f], solve.sky[i].longwave_down,
                                         kelvin[k], excess[k] + beyond[k](f) + float(tilt));
                }
            }
        });
        for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            float next[PackedField::run], change[PackedField::run];
            for (std::size_t f = begin; f < end; ++f) {
                arriving_longwave(solve.input.views, leaving, f, {next, width});
                solve.excess.get(run, f, change);
                float most = 0.0f;
                for (std::size_t k = 0; k < width; ++k) {
                    if (heights) next[k] -= (1.0f - solve.input.views.sky[f]) * beyond[k](f);
                    change[k] = next[k] - change[k];
                    most = std::max(most, std::abs(change[k]));
                }
                if (most <= solve.excess.step(run, f)) {
                    std::fill_n(change, width, 0.0f);
                } else {
                    solve.excess.put(run, f, next);
                    field.most[f] = std::max(field.most[f], most);
                }
                field.moved().put(run, f, change);
            }
        });
    }
}

/// Which facets send on what is reflected of the change; what of that comes back from a facet's own
/// like is taken in at once.
void reflect(SolveState& solve, float least, Field& field) {
    for_each_index(solve.facets, [&](std::size_t f) {
        const float reflectance = 1.0f - solve.optics.emissivity[f];
        const float back = field.to_and_fro(f, reflectance) - 1.0f;
        const bool counts = back * field.most[f] > 0.1f * least;
        for (std::size_t run = 0; counts && run < field.moved().runs(); ++run) {
            float change[PackedField::run], more[PackedField::run];
            field.moved().get(run, f, change);
            for (std::size_t k = 0; k < field.moved().width(run); ++k) {
                more[k] = back * change[k];
                change[k] += more[k];
            }
            add_to(solve.excess, run, f, more);
            field.moved().put(run, f, change);
        }
        if (counts) field.most[f] *= 1.0f + back;
        field.sends[f] = f < solve.counted && reflectance * field.most[f] > least * field.open;
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
Eigen::MatrixXf arrived_heat(std::span<const std::size_t> facets, float emissivity,
                             const Field& field) {
    Eigen::MatrixXf heat(Eigen::Index(field.used), Eigen::Index(facets.size()));
    for (std::size_t l = 0; l < facets.size(); ++l) {
        field.moved().get(facets[l], heat.col(Eigen::Index(l)).data());
    }
    return emissivity * heat;
}

/// Makes of what has arrived at facets what leaves them: what they reflect of it, and what they
/// send more that are warmer by so much, (instant, facet). What comes back from their own like has
/// been followed with it (left_of_slopes).
///
/// - own: (place in `facets`) 0: another block does so; empty: all 1
void send_more(SolveState& solve, std::span<const std::size_t> facets,
               const Eigen::MatrixXd& warmer, std::span<const std::uint8_t> own, Field& field) {
    for (std::size_t l = 0; l < facets.size(); ++l) {
        if (!own.empty() && own[l] == 0) continue;
        const std::size_t f = facets[l];
        const float emissivity = solve.optics.emissivity[f], itself = field.itself[f];
        const float all = field.to_and_fro(f, 1.0f - emissivity);
        const bool back = field.is_back(f);
        for (std::size_t run = 0; run < field.moved().runs(); ++run) {
            float kelvin[PackedField::run], more[PackedField::run], leaving[PackedField::run];
            const std::size_t width = field.moved().width(run);
            solve.kelvin.get(run, f, kelvin);
            for (std::size_t k = 0; k < width; ++k) {
                const auto row = Eigen::Index(run * PackedField::run + k);
                const float t = kelvin[k];
                more[k] = all * 4.0f * emissivity * float(stefan_boltzmann) * t * t * t *
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
double back_from_own_like(const SolveState& solve, std::size_t f, const Field& field) {
    if (field.itself[f] == 0.0f) return 0.0;
    double mean = 0.0;
    std::vector<float> kelvin(field.used);
    solve.kelvin.get(f, kelvin.data());
    for (const double t : kelvin) mean += t * t * t / double(field.used);
    const double emissivity = solve.optics.emissivity[f];
    return field.itself[f] * field.to_and_fro(f, float(1.0 - emissivity)) * 4.0 * emissivity *
           emissivity * stefan_boltzmann * mean;
}

/// What is left of facets' slopes where what they send more comes back from their own like: ground
/// below something that hides all else from it loses nothing by radiation.
Eigen::RowVectorXd left_of_slopes(const SolveState& solve, const Block& block,
                                  const Eigen::RowVectorXd& relative, const Field& field) {
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
void limit_moves(const Block& block, const Field& field, Eigen::MatrixXd& start) {
    constexpr float mostly = 0.5f;
    constexpr double farthest = 8.0;  // [K]
    for (Eigen::Index l = 0; l < start.cols(); ++l) {
        if (field.itself[block.facet[std::size_t(l)]] < mostly) continue;
        const double most = start.col(l).cwiseAbs().maxCoeff();
        if (most > farthest) start.col(l) *= farthest / most;
    }
}

/// What leaves backs has a place of its own.
void number_backs(const SolveState& solve, Field& field) {
    if (solve.other_side.empty()) return;
    field.back.assign(solve.facets, Field::no_back);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < solve.facets; ++f) {
        if (solve.is_back(f)) field.back[f] = count++;
    }
    field.of_back = PackedField::of_steps(field.used, 1, count);
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
    const std::size_t used = solve.steps() / level.stride + 1;
    std::vector<float> reflectance;
    for (const float emissivity : solve.optics.emissivity) {
        reflectance.push_back(1.0f - emissivity);
    }
    if (room.moved.slots() != used) {  // renew_all() computes all of it
        room.moved = PackedField::of_steps(used, 1, solve.facets);
    }
    Field field{.room = room,
                .used = used,
                .most = std::vector<float>(solve.facets),
                .sends = std::vector<std::uint8_t>(solve.facets, 0),
                .itself = std::vector<float>(solve.facets),
                .leaves = std::vector<std::uint8_t>(solve.facets, 0),
                .back = {},
                .open = 1.0f - greatest_sent_on(solve.input.views,
                                                std::span(reflectance).first(solve.counted))};
    for (std::size_t f = 0; f < solve.facets; ++f) {
        field.itself[f] = seen_as_itself(solve.input.views, f);
    }
    number_backs(solve, field);
    ExchangeChange result;
    renew_all(solve, level, field);
    for (const Block& block : solve.block) {
        if (level.kind[block.material].column.surface.emissivity > 0.0) continue;
        for (const std::size_t f : block.facet) {
            field.most[f] = 0.0f;
            field.moved().fill(f, 0.0f);
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
    reflect(solve, least, field);
    bool left = true;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const double warmer = follow(solve, level, least, field);
        result.warmer = std::max(result.warmer, warmer);
        if (warmer == 0.0 && !left) break;
        // What is reflected goes along with what is warmer; what is left of it then goes by itself.
        const bool all = warmer == 0.0 || sweep >= sweeps_together;
        left = send(solve, least, all ? enough_sweeps : 1, field);
        tell_blocks();
    }
    return result;
}

}  // namespace diurna
