#include "thermal/mode_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

/// exp(−z), (1 − exp(−z)) / z and (exp(−z) − 1 + z) / z² for z ≥ 0.
struct Phi {
    double decay, first, second;
};
Phi phi(double z) {
    const double gone = -std::expm1(-z);
    if (z < 1e-2) {
        return {1.0 - gone, 1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z / 120.0))),
                0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z * (1.0 / 120.0 - z / 720.0)))};
    }
    return {1.0 - gone, gone / z, (z - gone) / (z * z)};
}

constexpr double first_part = 30.0;   // [s] after a jump
constexpr double later_part = 120.0;  // [s] in the step after it

/// A facet's own way over part of a step.
struct Part {
    double temperature, drive, slope;
};

AirFilm between(const AirFilm& a, const AirFilm& b, double share) {
    AirFilm film = b;
    const auto mix = [share](double from, double to) { return from + share * (to - from); };
    film.air_temperature = mix(a.air_temperature, b.air_temperature);
    film.neutral = mix(a.neutral, b.neutral);
    film.instability = mix(a.instability, b.instability);
    film.heat_capacity = mix(a.heat_capacity, b.heat_capacity);
    film.vapour_pressure = mix(a.vapour_pressure, b.vapour_pressure);
    film.latent = mix(a.latent, b.latent);
    return film;
}

Part advance_part(const ModeStep& whole, double step, const AirFilm& air, double heat,
                  NaturalFilm natural, double emissivity, double drive, double guess,
                  double* state) {
    double a = 0.0, response = 0.0;
    double to[64];
    const std::size_t n = whole.modes();
    assert(n <= 64);
    for (std::size_t m = 0; m < n; ++m) {
        const Phi p = phi(whole.rate[m] * step);
        const double weight = whole.surface[m] * step;
        to[m] = weight * p.second;
        state[m] = p.decay * state[m] + weight * (p.first - p.second) * drive;
        a += whole.surface[m] * state[m];
        response += whole.surface[m] * to[m];
    }
    Part part{.temperature = guess, .drive = 0.0, .slope = 0.0};
    double flux;
    const double pull = a / response + whole.flux_below;
    solve_surface(air, {.count = 1,
                        .heat = &heat,
                        .natural = &natural,
                        .a = &pull,
                        .b = 1.0 / response - whole.film,
                        .reference = whole.reference,
                        .emissivity = emissivity,
                        .temperature = &part.temperature,
                        .flux = &flux,
                        .slope = &part.slope});
    part.drive = (part.temperature - whole.reference - a) / response;
    for (std::size_t m = 0; m < n; ++m) state[m] += to[m] * part.drive;
    return part;
}

}  // namespace

ModeStep make_mode_step(const ReducedColumn& column, const ClosedColumn& closed, double step) {
    ModeStep result{.step = step,
                    .film = closed.film,
                    .reference = column.reference,
                    .flux_below = column.flux_below,
                    .response = 0.0,
                    .rate = {},
                    .surface = {},
                    .decay = {},
                    .from = {},
                    .to = {}};
    for (Eigen::Index m = 0; m < closed.rate.size(); ++m) {
        const Phi p = phi(closed.rate[m] * step);
        const double weight = closed.surface[m] * step;
        result.rate.push_back(closed.rate[m]);
        result.surface.push_back(closed.surface[m]);
        result.decay.push_back(p.decay);
        result.from.push_back(weight * (p.first - p.second));
        result.to.push_back(weight * p.second);
        result.response += closed.surface[m] * weight * p.second;
    }
    return result;
}

void begin_modes(const ModeStep& step, const AirFilm& air, const double* heat, double emissivity,
                 ModeBatch& batch) {
    for (std::size_t l = 0; l < batch.count; ++l) {
        double theta = 0.0;
        for (std::size_t m = 0; m < step.modes(); ++m) {
            theta += step.surface[m] * batch.state[m * lanes + l];
        }
        const double t = theta + step.reference;
        const HeatBalance balance =
            heat_balance(air, batch.natural[l], emissivity, heat[l], 0.0, 0.0, t);
        batch.temperature[l] = t;
        batch.slope[l] = -step.film;  // a first guess
        // The flux from below drives the modes as one into the surface does; it rides along.
        batch.drive[l] = balance.sum() + step.film * theta + step.flux_below;
    }
}

void advance_modes(const ModeStep& step, const ModeForcing& forcing, double emissivity,
                   ModeBatch& batch, StepRecord& record) {
    const std::size_t n = step.modes(), count = batch.count;
    double* const state = batch.state.data();
    alignas(64) double a[lanes], pull[lanes], flux[lanes], before[lanes];
    const double* const drive = batch.drive.data();
    double kept[64], kept_drive[lanes];
    static thread_local std::vector<double> split;
    static thread_local std::vector<HeatJump> jumps;
    jumps.assign(forcing.jumps.begin(), forcing.jumps.end());
    for (const std::size_t lane : batch.unsettled) {
        const bool again = std::any_of(jumps.begin(), jumps.end(),
                                       [&](const HeatJump& jump) { return jump.lane == lane; });
        if (!again) jumps.push_back({lane, 0.0, 0.0});
    }
    batch.unsettled.clear();
    split.resize(jumps.size() * n);
    for (std::size_t j = 0; j < jumps.size(); ++j) {
        const std::size_t l = jumps[j].lane;
        for (std::size_t m = 0; m < n; ++m) split[j * n + m] = state[m * lanes + l];
        kept_drive[l] = drive[l];
    }

    std::fill_n(a, count, 0.0);
    for (std::size_t m = 0; m < n; ++m) {
        const double decay = step.decay[m], from = step.from[m], surface = step.surface[m];
        double* x = state + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < count; ++l) {
            x[l] = decay * x[l] + from * drive[l];
            a[l] += surface * x[l];
        }
    }
    const double stiffness = 1.0 / step.response, radiation = emissivity * stefan_boltzmann;
    const double warmer = forcing.air.air_temperature - forcing.air_before.air_temperature;
#pragma omp simd
    for (std::size_t l = 0; l < count; ++l) {
        pull[l] = stiffness * a[l] + step.flux_below;
        before[l] = batch.temperature[l];
        // Newton starts where the surface would be if it went on as straight as it was, under what
        // sun and air bring now.
        const double t = before[l], slope = batch.slope[l];
        const double brought = forcing.heat[l] - forcing.heat_before[l] -
                               (slope + 4.0 * radiation * t * t * t) * warmer;
        const double steep = slope + step.film;
        batch.temperature[l] =
            step.reference +
            (a[l] + step.response * (drive[l] + brought - steep * (t - step.reference))) /
                (1.0 - step.response * steep);
    }
    const SurfaceCount newton =
        solve_surface_near(forcing.air, {.count = count,
                                         .heat = forcing.heat,
                                         .natural = batch.natural.data(),
                                         .a = pull,
                                         .b = stiffness - step.film,
                                         .reference = step.reference,
                                         .emissivity = emissivity,
                                         .temperature = batch.temperature.data(),
                                         .flux = flux,
                                         .slope = batch.slope.data()});
    ++record.stages;
    record.iterations += newton.iterations;
    record.worst_iterations = std::max(record.worst_iterations, newton.iterations);
    record.bisections += newton.bisections;
    double worst = record.worst_closure;
#pragma omp simd reduction(max : worst)
    for (std::size_t l = 0; l < count; ++l) {
        const double t = batch.temperature[l], theta = t - step.reference;
        const double u = stiffness * (theta - a[l]);
        const double left = std::abs(flux[l] + step.film * theta + step.flux_below - u);
        const double terms =
            std::abs(forcing.heat[l]) + radiation * t * t * t * t + std::abs(flux[l]) + 1.0;
        worst = std::max(worst, left / terms);
        batch.drive[l] = u;
    }
    record.worst_closure = worst;
    for (std::size_t m = 0; m < n; ++m) {
        const double to = step.to[m];
        double* x = state + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < count; ++l) x[l] += to * drive[l];
    }

    // A surface that follows the film nearly at once takes its whole way in these two steps.
    const bool quick = step.response * step.film > 0.5;
    for (std::size_t j = 0; j < jumps.size(); ++j) {
        const HeatJump& jump = jumps[j];
        const std::size_t l = jump.lane;
        double* const x = split.data() + j * n;
        std::copy_n(x, n, kept);
        const AirFilm air = between(forcing.air_before, forcing.air, jump.share);
        const double heat = forcing.heat_before[l] +
                            jump.share * (forcing.heat[l] - forcing.heat_before[l] - jump.heat);
        const bool jumped = jump.share > 0.0;
        if (jumped && quick) batch.unsettled.push_back(l);
        Part part{before[l], kept_drive[l], 0.0};
        if (jumped) {
            part = advance_part(step, jump.share * step.step, air, heat, batch.natural[l],
                                emissivity, part.drive, part.temperature, kept);
            part.drive += jump.heat;
        }
        const double first_share = (jumped ? first_part : later_part) / step.step;
        double from = jump.share;
        while (from < 1.0) {
            // What the true film differs from the modes' follows the surface, which runs fast at
            // first: parts of growing length, the last not much shorter than the one before.
            double share = from + std::max(from - jump.share, first_share);
            if (1.0 - share < 0.5 * (share - from)) share = 1.0;
            const double grown = forcing.heat[l] - forcing.heat_before[l] - jump.heat;
            part = advance_part(step, (share - from) * step.step,
                                between(forcing.air_before, forcing.air, share),
                                forcing.heat[l] - (1.0 - share) * grown, batch.natural[l],
                                emissivity, part.drive, part.temperature, kept);
            from = share;
        }
        batch.temperature[l] = part.temperature;
        batch.drive[l] = part.drive;
        batch.slope[l] = part.slope;
        for (std::size_t m = 0; m < n; ++m) state[m * lanes + l] = kept[m];
    }
    double sum = 0.0;
    for (std::size_t l = 0; l < count; ++l) sum += batch.slope[l];
    record.slope[0] = sum;
}

}  // namespace diurna
