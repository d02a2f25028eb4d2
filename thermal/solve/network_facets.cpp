#include "thermal/solve/network_facets.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr double longest_step = 300.0;  // [s]
constexpr double repeats = 3e-3;        // [K] of a period that is found: what is slower than a
                                        // day is no part of a target
constexpr double counts = 0.3;          // [W m⁻²] of neighbours' heat: 0.015 K

std::vector<double> flat(const NetworkState& state) {
    std::vector<double> all = state.node;
    all.insert(all.end(), state.lump.begin(), state.lump.end());
    return all;
}

void set_out(const std::vector<double>& all, NetworkStepper& stepper) {
    NetworkState& state = stepper.state;
    const auto lumps = all.begin() + std::ptrdiff_t(state.node.size());
    std::copy(all.begin(), lumps, state.node.begin());
    std::copy(lumps, all.end(), state.lump.begin());
    stepper.begin();
}

/// The start of a period from those tried so far and what came of them: Anderson's mixing of the
/// last few (1965), which settles what is slower than the period.
class PeriodSearch {
 public:
    std::vector<double> next(const std::vector<double>& start, const std::vector<double>& end) {
        start_.push_back(
            Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index(start.size())));
        end_.push_back(Eigen::Map<const Eigen::VectorXd>(end.data(), Eigen::Index(end.size())));
        const std::size_t n = end_.size(), used = std::min<std::size_t>(n - 1, 3);
        Eigen::VectorXd mixed = end_.back();
        if (used > 0) {
            Eigen::MatrixXd change(mixed.size(), Eigen::Index(used)), moved = change;
            const Eigen::VectorXd missing = end_.back() - start_.back();
            for (std::size_t k = 0; k < used; ++k) {
                const std::size_t a = n - 1 - k, b = a - 1;
                moved.col(Eigen::Index(k)) = end_[a] - end_[b];
                change.col(Eigen::Index(k)) = (end_[a] - start_[a]) - (end_[b] - start_[b]);
            }
            mixed -= moved * change.colPivHouseholderQr().solve(missing);
        }
        return {mixed.data(), mixed.data() + mixed.size()};
    }

 private:
    std::vector<Eigen::VectorXd> start_, end_;
};

}  // namespace

NetworkFacets::NetworkFacets(const SolveState& solve) : solve_(solve) {
    for (const NetworkObject& object : solve.input.network) target_.push_back({.object = &object});
}

void NetworkFacets::set_out_from(const std::vector<std::vector<double>>& left) {
    for (std::size_t t = 0; t < std::min(left.size(), target_.size()); ++t) {
        target_[t].start = left[t];
    }
}

std::vector<std::vector<double>> NetworkFacets::left() const {
    std::vector<std::vector<double>> all;
    for (const Target& target : target_) all.push_back(target.end);
    return all;
}

std::vector<float> NetworkFacets::excess_on(const NetworkObject& object) const {
    std::vector<float> excess;
    if (solve_.excess.empty()) return excess;
    excess.reserve(2 * object.size() * solve_.instant.size());
    for (std::size_t i = 0; i < solve_.instant.size(); ++i) {
        const float* const row = solve_.excess.data() + i * solve_.facets;
        for (std::size_t n = 0; n < object.size(); ++n) {
            excess.push_back(row[object.facet[n]]);
            if (object.back[n] != no_number) excess.push_back(row[object.back[n]]);
        }
    }
    return excess;
}

bool NetworkFacets::rests(const Target& target) const {
    if (target.kelvin.empty() || solve_.record) return false;
    if (solve_.options.periodic && target.residual > repeats) return false;
    const std::vector<float> now = excess_on(*target.object);
    for (std::size_t k = 0; k < now.size(); ++k) {
        if (std::abs(now[k] - target.excess[k]) > counts) return false;
    }
    return true;
}

/// As warm as the blocks have it in the mean of the span; lumps as the air.
void NetworkFacets::guess(const Target& target, NetworkStepper& stepper) const {
    const NetworkObject& object = *target.object;
    const auto instants = double(solve_.instant.size());
    double all = 0.0;
    for (std::size_t n = 0; n < object.size(); ++n) {
        double mean = 0.0;
        for (std::size_t i = 0; i < solve_.instant.size(); ++i) {
            mean += solve_.kelvin[i * solve_.facets + object.facet[n]] / instants;
        }
        const NetworkSystem& system = stepper.system();
        for (std::size_t k = system.node_of(n); k <= system.last_of(n); ++k) {
            stepper.state.node[k] = mean;
        }
        all += mean / double(object.size());
    }
    std::fill(stepper.state.lump.begin(), stepper.state.lump.end(), all);
    std::fill(stepper.state.edge.begin(), stepper.state.edge.end(), all);
}

void NetworkFacets::march(NetworkSurroundings& around, NetworkStepper& stepper,
                          Target& target) const {
    const NetworkObject& object = *target.object;
    const std::size_t size = object.size();
    std::vector<double> outer(size), inner(size);
    const auto put_down = [&](std::size_t i) {
        stepper.ends(outer, inner);
        for (std::size_t n = 0; n < size; ++n) {
            target.kelvin[i * size + n] = float(outer[n]);
            target.back_kelvin[i * size + n] = float(inner[n]);
        }
        around.record(i, outer, inner);
    };
    target.kelvin.resize(solve_.instant.size() * size);
    target.back_kelvin.resize(target.kelvin.size());
    put_down(0);
    const double step = solve_.step / solve_.options.refinement;
    const int parts =
        solve_.options.refinement * int(std::max(1.0, std::ceil(step / longest_step - 1e-9)));
    for (std::size_t i = 0; i < solve_.steps(); ++i) {
        for (int s = 0; s < parts; ++s) {
            stepper.advance(solve_.step / parts, around.of_part(i, s, parts));
        }
        put_down(i + 1);
    }
}

void NetworkFacets::run(const Level& level, Target& target) const {
    // The first time until it repeats; then once each time that its neighbours have changed, from
    // the start that the time before has found.
    const int most_passes = target.kelvin.empty() ? 12 : 1;
    NetworkStepper stepper(target.object->network);
    NetworkSurroundings around(solve_, level, *target.object);
    target.excess = excess_on(*target.object);
    if (target.start.empty()) {
        guess(target, stepper);
        target.start = flat(stepper.state);
    }
    PeriodSearch search;
    for (int pass = 0; pass < most_passes; ++pass) {
        set_out(target.start, stepper);
        march(around, stepper, target);
        target.end = flat(stepper.state);
        if (!solve_.options.periodic) break;
        target.residual = 0.0;
        for (std::size_t k = 0; k < target.end.size(); ++k) {
            target.residual = std::max(target.residual, std::abs(target.end[k] - target.start[k]));
        }
        if (target.residual <= repeats) break;
        target.start = search.next(target.start, target.end);
    }
    target.count = stepper.count;
}

void NetworkFacets::pass(SolveState& solve, const Level& level) {
    std::vector<Target*> waiting;
    for (Target& target : target_) {
        if (!rests(target)) waiting.push_back(&target);
    }
    for_each_index(
        waiting.size(), [&](std::size_t t) { run(level, *waiting[t]); }, 1);
    put(solve);
}

void NetworkFacets::put(SolveState& solve) const {
    for (const Target& target : target_) {
        if (target.kelvin.empty()) continue;
        const NetworkObject& object = *target.object;
        for (std::size_t i = 0; i < solve.instant.size(); ++i) {
            float* const row = solve.kelvin.data() + i * solve.facets;
            for (std::size_t n = 0; n < object.size(); ++n) {
                row[object.facet[n]] = target.kelvin[i * object.size() + n];
                if (object.back[n] != no_number) {
                    row[object.back[n]] = target.back_kelvin[i * object.size() + n];
                }
            }
        }
    }
}

bool NetworkFacets::at_rest() const {
    return std::all_of(target_.begin(), target_.end(),
                       [&](const Target& target) { return rests(target); });
}

NetworkFacets::Summary NetworkFacets::summary() const {
    Summary all;
    for (const Target& target : target_) {
        all.residual = std::max(all.residual, target.residual);
        all.worst_closure = std::max(all.worst_closure, target.count.worst_closure);
        all.limited += target.count.limited;
        all.facets += target.object->size();
    }
    return all;
}

}  // namespace diurna
