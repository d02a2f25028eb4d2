#include "thermal/solve/moved_longwave.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "terrain/visibility/interreflection.hpp"

namespace diurna {

float largest(std::span<const float> x) {
    float most = 0.0f;
    for (const float v : x) most = std::max(most, std::abs(v));
    return most;
}

void leaving_of(const SolveState& solve, const MovedLongwave& field, std::size_t run, std::size_t f,
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

void add_to(PackedField& values, std::size_t run, std::size_t f, const float* more) {
    float sum[PackedField::run];
    values.get(run, f, sum);
    for (std::size_t k = 0; k < values.width(run); ++k) sum[k] += more[k];
    values.put(run, f, sum);
}

namespace {

constexpr std::size_t facets_at_once = 256;

/// Runs of instants that the exchange computes together, so that rows of view factors are read once
/// for them.
class RunsTogether {
    static constexpr std::size_t most_runs = 4;

 public:
    static constexpr std::size_t most = most_runs * PackedField::run;  // instants

    /// The first ones.
    explicit RunsTogether(const PackedField& field) : field_(field) {}
    bool any() const { return first_ < field_.runs(); }
    void next() { first_ += together_; }
    /// Their first slot, and the number of their slots.
    std::size_t slot() const { return first_ * PackedField::run; }
    std::size_t width() const {
        return std::min(together_ * PackedField::run, field_.slots() - slot());
    }
    /// The same rounded up to whole runs: values beyond are zero, so that loops have whole vectors.
    std::size_t wide() const { return PackedField::whole_runs(width()); }
    /// Calls body(run, its first slot among these, its slots).
    template <class Body>
    [[gnu::always_inline]] void each(const Body& body) const {
        const std::size_t last = std::min(field_.runs(), first_ + together_);
        for (std::size_t run = first_; run < last; ++run) {
            body(run, (run - first_) * PackedField::run, field_.width(run));
        }
    }
    /// A facet's values of a field with the same slots.
    void get(const PackedField& field, std::size_t f, float* values) const {
        each([&](std::size_t run, std::size_t at, std::size_t) { field.get(run, f, values + at); });
    }

 private:
    const PackedField& field_;
    std::size_t together_ = runs_at_once(field_.facets(), most_runs), first_ = 0;
};

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

}  // namespace

const float* MovedLongwave::kelvin_of(const SolveState& solve, std::size_t f, std::size_t slot,
                                      std::vector<float>& all, std::vector<float>& chosen) const {
    const PackedField& field = solve.kelvin;
    if (apart == 1) {
        for (std::size_t k = 0; k < chosen.size(); k += PackedField::run) {
            field.get((slot + k) / PackedField::run, f, chosen.data() + k);
        }
        return chosen.data();
    }
    field.get(f, all.data());
    for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = all[(slot + k) * apart];
    return chosen.data();
}

void recompute_longwave(SolveState& solve, const Level& level, MovedLongwave& field) {
    const bool heights = !solve.tiers.flat();
    const std::size_t stride = level.stride * field.apart;  // instants
    std::vector<float>& leaving = field.room.leaving;
    for (RunsTogether runs(field.moved()); runs.any(); runs.next()) {
        const std::size_t width = runs.width(), wide = runs.wide();
        std::vector<SkyBeyond> beyond;
        for (std::size_t k = 0; k < width; ++k) {
            beyond.emplace_back(solve, (runs.slot() + k) * stride);
        }
        leaving.resize(solve.facets * wide);
        for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            float excess[RunsTogether::most];
            std::vector<float> all(solve.kelvin.slots()), chosen(width);
            for (std::size_t f = begin; f < end; ++f) {
                const float* const kelvin = field.kelvin_of(solve, f, runs.slot(), all, chosen);
                runs.get(solve.excess, f, excess);
                for (std::size_t k = 0; k < width; ++k) {
                    const std::size_t i = (runs.slot() + k) * stride;
                    // What falls on it beyond the sky: of neighbours, of a sky that differs by
                    // height and by direction.
                    const double tilt =
                        solve.tilt.empty()
                            ? 0.0
                            : solve.at_facet(&SkyState::tilted_longwave, i, f) * solve.tilt[f];
                    leaving[f * wide + k] =
                        leaving_longwave(solve.optics.emissivity[f], solve.sky[i].longwave_down,
                                         kelvin[k], excess[k] + beyond[k](f) + float(tilt));
                }
                std::fill_n(&leaving[f * wide] + width, wide - width, 0.0f);
            }
        });
        for_each_block(solve.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            float next[RunsTogether::most], change[RunsTogether::most];
            for (std::size_t f = begin; f < end; ++f) {
                arriving_longwave(solve.input.views, leaving, f, {next, wide});
                runs.get(solve.excess, f, change);
                for (std::size_t k = 0; k < width; ++k) {
                    if (heights) next[k] -= (1.0f - solve.input.views.sky[f]) * beyond[k](f);
                    change[k] = next[k] - change[k];
                }
                runs.each([&](std::size_t run, std::size_t at, std::size_t n) {
                    const float most = largest({change + at, n});
                    if (most <= solve.excess.step(run, f)) {
                        std::fill_n(change + at, n, 0.0f);
                    } else {
                        solve.excess.put(run, f, next + at);
                        field.most[f] = std::max(field.most[f], most);
                    }
                    field.moved().put(run, f, change + at);
                });
            }
        });
    }
}

void reflect_longwave(SolveState& solve, float least, MovedLongwave& field) {
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

bool send_longwave(SolveState& solve, float least, int sweeps, MovedLongwave& field) {
    const FacetViews& view = solve.input.views;
    const SeenRows rows{
        .row = view.others.row, .source = view.others.facet, .factor = view.others.factor};
    const float scale = 1.0f / (least * field.open), nothing[PackedField::run] = {};
    std::vector<float> counts(solve.facets), most(solve.facets, 0.0f);
    std::vector<std::uint8_t> left(solve.facets, 0);
    std::vector<float>& leaving = field.room.leaving;
    for (RunsTogether runs(field.moved()); runs.any(); runs.next()) {
        const std::size_t width = runs.width(), wide = runs.wide();
        leaving.resize(solve.facets * wide);
        for_each_index(solve.facets, [&](std::size_t f) {
            float* const out = leaving.data() + f * wide;
            std::fill(out + width, out + wide, 0.0f);
            runs.each([&](std::size_t run, std::size_t at, std::size_t) {
                leaving_of(solve, field, run, f, out + at);
                field.moved().put(run, f, nothing);
            });
            counts[f] = field.sends[f] ? scale * largest({out, width}) : 0.0f;
        });
        interreflect(
            rows, {.value = leaving.data(), .stride = wide, .lanes = wide, .counts = counts},
            [&](std::size_t f, const float* now, float* unsent) {
                const float reflectance = 1.0f - solve.optics.emissivity[f];
                const float all = field.to_and_fro(f, reflectance);
                float more[RunsTogether::most];
                for (std::size_t k = 0; k < width; ++k) {
                    more[k] = all * now[k];
                    unsent[k] += reflectance * more[k];
                }
                runs.each([&](std::size_t run, std::size_t at, std::size_t) {
                    add_to(field.moved(), run, f, more + at);
                });
                return f < solve.counted ? scale * largest({unsent, width}) : 0.0f;
            },
            sweeps);
        for_each_index(solve.facets, [&](std::size_t f) {
            float sum[RunsTogether::most];
            runs.get(field.moved(), f, sum);
            left[f] |= counts[f] > 1.0f;
            most[f] = std::max(most[f], largest({sum, width}));
            runs.each([&](std::size_t run, std::size_t at, std::size_t n) {
                if (largest({sum + at, n}) > 0.0f) add_to(solve.excess, run, f, sum + at);
            });
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

}  // namespace diurna
