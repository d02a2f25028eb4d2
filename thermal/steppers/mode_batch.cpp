#include "thermal/steppers/mode_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/air/saturation.hpp"
#include "thermal/column/step_weights.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/surface/heat_balance.hpp"

namespace diurna {

namespace {

const ModeKernel& kernel() { return wide_vectors() ? modes_avx512 : modes_avx2; }

/// [K] where the balance bends: the air's dew point, on a surface that evaporates or takes dew.
double bend_of(const AirFilm& air) {
    return air.wetness > 0.0 ? dew_point(air.vapour_pressure) : 0.0;
}

/// What the kernels need of the air above, for lanes from `up` on.
AirAbove above(const ModeForcing& forcing, const double* up) {
    if (!forcing.air.up) return {};
    return {.before = forcing.air_before.high,
            .air = forcing.air.high,
            .dew_point_before = bend_of(*forcing.air_before.high),
            .dew_point = bend_of(*forcing.air.high),
            .up = up};
}

/// Of a lane's first mode in ModeBatch::state.
std::size_t place(const ModeStep& step, std::size_t lane) {
    return lane / lanes * step.modes() * lanes + lane % lanes;
}

/// The lanes that leave the others' step, each with the state it had before.
struct Outliers {
    std::size_t count = 0;
    std::size_t lane[split_capacity];
    NaturalFilm natural[split_capacity];
    alignas(64) double share[split_capacity], jump[split_capacity], up[split_capacity];
    alignas(64) double heat_before[split_capacity], heat[split_capacity];
    alignas(64) double temperature[split_capacity], drive[split_capacity], slope[split_capacity];
    alignas(64) double state[most_modes * split_capacity], to[most_modes * split_capacity];

    void take(const ModeStep& step, const ModeForcing& forcing, const ModeBatch& batch,
              const HeatJump& edge) {
        const std::size_t k = count++, l = edge.lane;
        lane[k] = l;
        natural[k] = batch.natural[l];
        share[k] = edge.share;
        jump[k] = edge.heat;
        up[k] = forcing.air.up ? forcing.air.up[l] : 0.0;
        heat_before[k] = forcing.heat_before[l];
        heat[k] = forcing.heat[l];
        temperature[k] = batch.temperature[l];
        drive[k] = batch.drive[l];
        slope[k] = batch.slope[l];
        const double* const x = batch.state.data() + place(step, l);
        for (std::size_t m = 0; m < step.modes(); ++m) {
            state[m * split_capacity + k] = x[m * lanes] + step.to[m] * batch.drive[l];
        }
    }
    /// Fills the last vector with copies of the last lane; returns the vectors.
    std::size_t fill(std::size_t modes) {
        const std::size_t groups = (count + split_lanes - 1) / split_lanes, last = count - 1;
        for (std::size_t k = count; k < groups * split_lanes; ++k) {
            natural[k] = natural[last];
            for (double* column : {share, jump, up, heat_before, heat, temperature, drive, slope}) {
                column[k] = column[last];
            }
            for (std::size_t m = 0; m < modes; ++m) {
                state[m * split_capacity + k] = state[m * split_capacity + last];
            }
        }
        return groups;
    }
    void give(const ModeStep& step, ModeBatch& batch, std::size_t k) const {
        const std::size_t l = lane[k];
        batch.temperature[l] = temperature[k];
        batch.drive[l] = drive[k];
        batch.slope[l] = slope[k];
        double* const x = batch.state.data() + place(step, l);
        for (std::size_t m = 0; m < step.modes(); ++m) {
            x[m * lanes] = state[m * split_capacity + k] - step.to[m] * drive[k];
        }
    }
};

/// The lanes with a jump of heat in this step, or in the last where that is divided too.
void take_outliers(const ModeStep& step, const ModeForcing& forcing, ModeBatch& batch,
                   Outliers& outliers) {
    outliers.count = 0;
    for (const HeatJump& edge : forcing.jumps) outliers.take(step, forcing, batch, edge);
    for (const std::size_t l : batch.unsettled) {
        const bool again = std::any_of(forcing.jumps.begin(), forcing.jumps.end(),
                                       [&](const HeatJump& edge) { return edge.lane == l; });
        if (!again) outliers.take(step, forcing, batch, {.lane = l, .share = 1e-3, .heat = 0.0});
    }
    batch.unsettled.clear();
    // A surface that follows the film nearly at once takes its whole way in two steps.
    if (step.response * step.film > 0.5) {
        for (const HeatJump& edge : forcing.jumps) batch.unsettled.push_back(edge.lane);
    }
}

/// The outliers' whole step, in parts.
void split_outliers(const ModeStep& step, const ModeForcing& forcing, double emissivity,
                    Outliers& outliers, StepRecord& record) {
    const std::size_t groups = outliers.fill(step.modes());
    const bool halved =
        kernel().split(forcing.air_before.low, forcing.air.low, step.coefficients(emissivity),
                       {.groups = groups,
                        .dew_point_before = bend_of(forcing.air_before.low),
                        .dew_point = bend_of(forcing.air.low),
                        .natural = outliers.natural,
                        .share = outliers.share,
                        .jump = outliers.jump,
                        .heat_before = outliers.heat_before,
                        .heat = outliers.heat,
                        .state = outliers.state,
                        .temperature = outliers.temperature,
                        .drive = outliers.drive,
                        .slope = outliers.slope,
                        .to = outliers.to,
                        .above = above(forcing, outliers.up)});
    record.bisections += halved ? outliers.count : 0;
}

/// All units at one pace.
void advance_units(const ModeStep& step, const ModeForcing& forcing, double emissivity,
                   ModeBatch& batch, StepRecord& record) {
    const ModeCoefficients coefficients = step.coefficients(emissivity);
    const double bend = bend_of(forcing.air.low);
    AirAbove high = above(forcing, forcing.air.up);
    for (std::size_t u = 0; u < batch.units(); ++u) {
        const std::size_t first = u * lanes;
        const ModeOutcome outcome =
            kernel().advance(forcing.air_before.low, forcing.air.low, coefficients,
                             {.dew_point = bend,
                              .natural = batch.natural.data() + first,
                              .heat_before = forcing.heat_before + first,
                              .heat = forcing.heat + first,
                              .state = batch.state.data() + first * step.modes(),
                              .temperature = batch.temperature.data() + first,
                              .drive = batch.drive.data() + first,
                              .slope = batch.slope.data() + first,
                              .above = high});
        if (high.up) high.up += lanes;
        record.count(outcome.iterations, outcome.halved ? std::min(lanes, batch.count - first) : 0);
        record.worst_closure = std::max(record.worst_closure, outcome.closure);
    }
}

}  // namespace

ModeCoefficients ModeStep::coefficients(double emissivity) const {
    return {.modes = modes(),
            .rate = rate.data(),
            .surface = surface.data(),
            .decay = decay.data(),
            .carry = carry.data(),
            .response = response,
            .film = film,
            .reference = reference,
            .flux_below = flux_below,
            .emissivity = emissivity,
            .step = step,
            .quick = quick};
}

ModeStep make_mode_step(const ReducedColumn& column, const ClosedColumn& closed, double step) {
    assert(std::size_t(closed.rate.size()) <= most_modes);
    ModeStep result{.step = step,
                    .film = closed.film,
                    .reference = column.reference,
                    .flux_below = column.flux_below,
                    .response = 0.0,
                    .rate = {},
                    .surface = {},
                    .decay = {},
                    .from = {},
                    .to = {},
                    .carry = {},
                    .quick = false};
    for (Eigen::Index m = 0; m < closed.rate.size(); ++m) {
        const StepWeights p = step_weights(closed.rate[m] * step);
        const double weight = closed.surface[m] * step;
        result.rate.push_back(closed.rate[m]);
        result.surface.push_back(closed.surface[m]);
        result.decay.push_back(p.decay);
        result.from.push_back(weight * (p.first - p.second));
        result.to.push_back(weight * p.second);
        result.carry.push_back(weight * (p.decay * p.second + p.first - p.second));
        result.response += closed.surface[m] * weight * p.second;
    }
    return result;
}

void ModeBatch::resize(std::size_t modes, std::size_t facets) {
    assert(facets > 0 && facets <= mode_lanes);
    count = facets;
    state.assign(units() * modes * lanes, 0.0);
}

void begin_modes(const ModeStep& step, const AirOver& air, const double* heat, double emissivity,
                 ModeBatch& batch) {
    for (std::size_t l = 0; l < batch.units() * lanes; ++l) {
        const std::size_t first = l / lanes * lanes;
        double* const x = batch.state.data() + place(step, l);
        if (l >= batch.count) {
            batch.natural[l] = batch.natural[first];
            const double* const same = batch.state.data() + place(step, first);
            for (std::size_t m = 0; m < step.modes(); ++m) {
                x[m * lanes] = same[m * lanes] + step.to[m] * batch.drive[first];
            }
        }
        double theta = 0.0;
        for (std::size_t m = 0; m < step.modes(); ++m) theta += step.surface[m] * x[m * lanes];
        const double t = theta + step.reference;
        const HeatBalance balance =
            heat_balance(air.at(l), batch.natural[l], emissivity, {.absorbed_solar = heat[l]}, t);
        batch.temperature[l] = t;
        batch.slope[l] = -step.film;  // a first guess
        // The flux from below drives the modes as one into the surface does; it rides along.
        batch.drive[l] = balance.sum() + step.film * theta + step.flux_below;
        for (std::size_t m = 0; m < step.modes(); ++m) x[m * lanes] -= step.to[m] * batch.drive[l];
    }
}

void end_modes(const ModeStep& step, ModeBatch& batch) {
    for (std::size_t l = 0; l < batch.units() * lanes; ++l) {
        double* const x = batch.state.data() + place(step, l);
        for (std::size_t m = 0; m < step.modes(); ++m) x[m * lanes] += step.to[m] * batch.drive[l];
    }
}

void advance_modes(const ModeStep& step, const ModeForcing& forcing, double emissivity,
                   ModeBatch& batch, StepRecord& record) {
    static thread_local Outliers outliers;
    take_outliers(step, forcing, batch, outliers);
    advance_units(step, forcing, emissivity, batch, record);
    if (outliers.count > 0) {
        split_outliers(step, forcing, emissivity, outliers, record);
        for (std::size_t k = 0; k < outliers.count; ++k) outliers.give(step, batch, k);
    }
    double sum = 0.0;
    for (std::size_t l = 0; l < batch.count; ++l) sum += batch.slope[l];
    record.slope[0] = sum;
}

}  // namespace diurna
