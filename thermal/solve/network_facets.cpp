#include "thermal/solve/network_facets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "thermal/solve/network_period.hpp"

namespace diurna {

namespace {

constexpr double longest_step = 300.0;          // [s] where temperatures bend
constexpr double longest_straight = 600.0;      // [s] elsewhere
constexpr double any_step = 1e9;                // [s] for a first guess
constexpr double straight = 0.02;               // [K] rms of what bends from step to step
constexpr double repeats_within = 3e-3;         // [K] of a period that is found
constexpr double repeats_in_hours = 0.3;        // [K] of one that is only a first guess
constexpr double usual_loss_of_network = 20.0;  // [W m⁻² K⁻¹] radiation and air together
constexpr double far_from_alike = 30.0;         // [W m⁻²] likewise: the march need not close
/// [W m⁻²] of neighbours' heat, where a run may be the last: a rough march would leave as much.
constexpr double nearly_done = 4.0;
constexpr std::size_t stages_of_step = 2;

/// What a march may leave of the heat that flows: where neighbours are nearly known; before; where
/// they are far from known.
constexpr double last_closes = 4e-9, others_close = 1e-5, first_closes = 1e-4;

/// Instants from step to step of a march whose neighbours are not known at all: no more than a
/// quarter of an hour, an equal part of the span.
std::size_t rough_stride(const SolveState& solve) {
    constexpr double longest = 900.0;  // [s]
    auto stride = std::size_t(std::max(1.0, std::floor(longest / solve.step + 1e-9)));
    while (solve.steps() % stride != 0) --stride;
    return stride;
}

std::vector<double> flat(const NetworkState& state) {
    std::vector<double> all = state.node;
    all.insert(all.end(), state.lump.begin(), state.lump.end());
    return all;
}

double farthest_apart(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

void set_out(const std::vector<double>& all, NetworkStepper& stepper) {
    NetworkState& state = stepper.state;
    const auto lumps = all.begin() + std::ptrdiff_t(state.node.size());
    std::copy(all.begin(), lumps, state.node.begin());
    std::copy(lumps, all.end(), state.lump.begin());
    stepper.begin();
}

/// How far temperatures at the ends of two equal steps are from a straight line.
class Bend {
 public:
    /// The next temperatures [K].
    void add(const std::vector<double>& kelvin) {
        if (last_.size() == kelvin.size()) {
            double sum = 0.0;
            for (std::size_t k = 0; k < kelvin.size(); ++k) {
                const double change = kelvin[k] - last_[k];
                if (!change_.empty()) sum += (change - change_[k]) * (change - change_[k]);
                last_[k] = change;
            }
            rms_ = change_.empty() ? 1e9 : std::sqrt(sum / double(kelvin.size()));
            change_.swap(last_);
        }
        last_ = kelvin;
    }
    double rms() const { return rms_; }  // [K]

 private:
    std::vector<double> last_, change_;
    double rms_ = 1e9;
};

}  // namespace

NetworkFacets::NetworkFacets(const SolveState& solve, bool near) : solve_(solve), near_(near) {
    for (const NetworkObject& object : solve.input.network) target_.push_back({.object = &object});
}

void NetworkFacets::set_out_from(const std::vector<std::vector<double>>& left) {
    for (std::size_t t = 0; t < std::min(left.size(), target_.size()); ++t) {
        const HeatNetwork& network = target_[t].object->network;
        std::size_t values = network.lump.size();
        for (std::size_t f = 0; f < network.facet.size(); ++f) values += network.grid_of(f).size();
        if (left[t].size() != values) {
            if (solve_.options.periodic) continue;  // only a first guess
            throw InputError("thermal solve", "the initial state belongs to other targets");
        }
        target_[t].start = left[t];
    }
}

std::vector<std::vector<double>> NetworkFacets::left() const {
    std::vector<std::vector<double>> all;
    for (const Target& target : target_) all.push_back(target.end);
    return all;
}

/// [W m⁻²] by which neighbours' heat differs from that of the last run.
double NetworkFacets::moved(const Target& target) const {
    if (target.kelvin.empty()) return 1e9;
    if (solve_.excess.empty()) return 0.0;
    const NetworkObject& object = *target.object;
    double most = 0.0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < solve_.instant.size(); i += target.stride) {
        const PackedField::Row row = solve_.excess.row(i);
        for (std::size_t n = 0; n < object.size(); ++n) {
            most = std::max(most, std::abs(double(row(object.facet[n]) - target.excess[k++])));
            if (object.back[n] == no_number) continue;
            most = std::max(most, std::abs(double(row(object.back[n]) - target.excess[k++])));
        }
    }
    return most;
}

/// [K] of a day from what many more would lead to, and of what neighbours' heat has changed since.
double NetworkFacets::error(const Target& target) const {
    const double open = solve_.options.periodic ? target.move : 0.0;
    return std::max(open, moved(target) / usual_loss_of_network);
}

bool NetworkFacets::rests(const Target& target, double limit) const {
    return target.closed && !solve_.record && error(target) <= limit;
}

/// In balance with the span's mean; where that has no end, as warm as the blocks have it.
void NetworkFacets::guess(const Target& target, NetworkSurroundings& around,
                          NetworkStepper& stepper) const {
    const NetworkObject& object = *target.object;
    const auto instants = double(solve_.instant.size());
    for (std::size_t n = 0; n < object.size(); ++n) {
        double mean = 0.0;
        for (std::size_t i = 0; i < solve_.instant.size(); ++i) {
            mean += double(solve_.kelvin.at(i, object.facet[n])) / instants;
        }
        const NetworkSystem& system = stepper.system();
        for (std::size_t k = system.node_of(n); k <= system.last_of(n); ++k) {
            stepper.state.node[k] = mean;
        }
    }
    std::fill(stepper.state.lump.begin(), stepper.state.lump.end(), around.mean_air());
    std::fill(stepper.state.edge.begin(), stepper.state.edge.end(), around.mean_air());
    constexpr double for_ever = 1e9;  // [s]
    const NetworkState blocks = stepper.state;
    const NetworkForcing mean = around.of_mean();
    for (int i = 0; i < 2; ++i) {
        stepper.advance(for_ever, mean);
        stepper.begin();
    }
    if (stepper.count.limited > 0) stepper.state = blocks;
    stepper.count = {};
}

void NetworkFacets::put_down(std::size_t i, const NetworkStepper& stepper,
                             NetworkSurroundings& around, Target& target) const {
    const std::size_t size = target.object->size();
    std::vector<double> outer(size), inner(size);
    stepper.ends(outer, inner);
    for (std::size_t n = 0; n < size; ++n) {
        target.kelvin[i * size + n] = float(outer[n]);
        target.back_kelvin[i * size + n] = float(inner[n]);
    }
    around.record(i, outer, inner, stepper.state.lump);
    around.excess(i, target.excess);
    around.follow(i, outer, inner);
}

void NetworkFacets::march(double longest, NetworkSurroundings& around, NetworkStepper& stepper,
                          NetworkPeriod& period, Target& target) const {
    const std::size_t values = (around.steps() + 1) * target.object->size();
    target.kelvin.resize(values);
    target.back_kelvin.resize(values);
    target.excess.clear();
    around.begin();
    period.begin();
    std::vector<double> outer(target.object->size()), inner(outer);
    stepper.ends(outer, inner);
    constexpr int reflections = 2;
    for (int i = 0; i < reflections; ++i) around.follow(0, outer, inner);
    put_down(0, stepper, around, target);
    const double level_step = solve_.step * double(target.stride);
    const double step = solve_.step / solve_.options.refinement;
    const auto parts_of = [&](double most) {
        return solve_.options.refinement * int(std::max(1.0, std::ceil(step / most - 1e-9)));
    };
    const int own = parts_of(longest), fewer = std::min(own, parts_of(longest_straight));
    target.parts.resize(around.steps(), 0);
    Bend bend;
    bend.add(stepper.state.node);
    for (std::size_t i = 0; i < around.steps(); ++i) {
        // Never fewer again: neighbours would not settle between two ways of stepping.
        int& parts = target.parts[i];
        parts = std::max(parts, bend.rms() < straight ? fewer : own);
        target.course.begin_step(i, stages_of_step * std::size_t(parts));
        for (int s = 0; s < parts; ++s) {
            stepper.advance(level_step / parts, around.of_part(i, s, parts));
        }
        if (solve_.options.periodic) period.add(stepper);
        bend.add(stepper.state.node);
        put_down(i + 1, stepper, around, target);
    }
}

void NetworkFacets::run(const Level& level, Target& target) const {
    const bool first = target.kelvin.empty();
    constexpr double unknown = 1e9;
    const double open = target.level == level.stride && !first ? moved(target)
                        : near_                                ? far_from_alike
                                                               : unknown;
    const bool in_hours = level.stride > 1;
    // While neighbours still change, once each time, from the start that the time before has found.
    const bool once = !first && (in_hours || open > usual_loss_of_network * repeats_within);
    const int most_marches = once ? 1 : 12;
    if (!target.stepper) {
        target.stepper = std::make_unique<NetworkStepper>(target.object->network);
        target.period = std::make_unique<NetworkPeriod>(target.object->network);
    }
    NetworkStepper& stepper = *target.stepper;
    NetworkPeriod& period = *target.period;
    target.closed = !in_hours && (open <= nearly_done || solve_.excess.empty() || solve_.record);
    const bool leads_in = solve_.options.leads_in;
    const bool last = target.closed && (!leads_in || solve_.record);
    const bool far = !target.closed && open > far_from_alike,
               nothing_known = far && open >= unknown;
    stepper.closed = target.closed ? last_closes : in_hours || far ? first_closes : others_close;
    stepper.confirmed = target.closed;
    target.level = level.stride;
    const std::size_t stride_before = target.stride;
    const double longest = in_hours || nothing_known    ? any_step
                           : far || (leads_in && !last) ? longest_straight
                                                        : longest_step;
    target.stride = !in_hours && nothing_known ? rough_stride(solve_) : level.stride;
    NetworkSurroundings around(solve_, level, *target.object, target.stride);
    const bool other_steps = target.stride != stride_before;
    if (other_steps) {
        target.course.clear();
        target.parts.clear();
    }
    if (target.start.empty()) {
        guess(target, around, stepper);
        target.start = flat(stepper.state);
    }
    stepper.course = &target.course;
    const double span = solve_.step * double(solve_.steps());
    for (int i = 0; i < most_marches; ++i) {
        stepper.count = {};
        set_out(target.start, stepper);
        march(longest, around, stepper, period, target);
        target.end = flat(stepper.state);
        if (!solve_.options.periodic) break;
        const std::vector<double> onward = period.next(target.start, target.end, span);
        target.residual = farthest_apart(target.end, target.start);
        target.move = farthest_apart(onward, target.start);
        target.start = onward;
        if (target.move <= (in_hours ? repeats_in_hours : repeats_within)) break;
    }
    target.count = stepper.count;
}

void NetworkFacets::pass(SolveState& solve, const Level& level) {
    std::vector<Target*> waiting;
    for (Target& target : target_) {
        if (!rests(target, solve_.options.settled)) waiting.push_back(&target);
    }
    for_each_index(
        waiting.size(), [&](std::size_t t) { run(level, *waiting[t]); }, 1);
    put(solve);
}

void NetworkFacets::put(SolveState& solve) const {
    for (const Target& target : target_) {
        if (target.kelvin.empty()) continue;
        const NetworkObject& object = *target.object;
        const std::size_t size = object.size();
        std::vector<float> row(solve.kelvin.slots());
        const auto put = [&](const std::vector<float>& of, std::size_t n, std::size_t facet) {
            for (std::size_t k = 0; k < row.size(); ++k) {
                const std::size_t i = k * target.level;
                const std::size_t before = i / target.stride,
                                  after = (i + target.stride - 1) / target.stride;
                const float share = float(i % target.stride) / float(target.stride);
                const float then = of[before * size + n];
                row[k] = then + share * (of[after * size + n] - then);
            }
            solve.kelvin.put(facet, row.data());
        };
        for (std::size_t n = 0; n < size; ++n) {
            put(target.kelvin, n, object.facet[n]);
            if (object.back[n] != no_number) put(target.back_kelvin, n, object.back[n]);
        }
    }
}

bool NetworkFacets::at_rest(double limit) const {
    return std::all_of(target_.begin(), target_.end(),
                       [&](const Target& target) { return rests(target, limit); });
}

double NetworkFacets::moved() const {
    double most = 0.0;
    for (const Target& target : target_) most = std::max(most, moved(target));
    return most;
}

NetworkFacets::Summary NetworkFacets::summary() const {
    Summary all;
    for (const Target& target : target_) {
        all.residual = std::max(all.residual, target.residual);
        all.error = std::max(all.error, error(target));
        all.worst_closure = std::max(all.worst_closure, target.count.worst_closure);
        if (all.limited == 0 && target.count.limited > 0) all.first_limited = target.object->name;
        all.limited += target.count.limited;
        all.facets += target.object->size();
    }
    return all;
}

}  // namespace diurna
