#include "bench/column_peers.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/steppers/layered_step.hpp"
#include "thermal/surface/heat_balance.hpp"

namespace diurna {

namespace {

struct Problem {
    const FacetDay& day;
    double heat_0, heat_1, from, length;  // heat is linear over this stretch of time
};

int derivative(double t, N_Vector y, N_Vector rate, void* user) {
    const Problem& p = *static_cast<const Problem*>(user);
    const MaterialColumn& c = *p.day.column;
    const double* const x = N_VGetArrayPointer(y);
    double* const dx = N_VGetArrayPointer(rate);
    const StageForcing now = p.day.air_at(t);
    const double heat = p.heat_0 + (p.heat_1 - p.heat_0) * (t - p.from) / p.length;
    double down = heat_balance(now.air, p.day.natural, c.surface.emissivity,
                               {.absorbed_solar = heat, .longwave = now.sky_longwave}, x[0])
                      .sum();
    const std::size_t n = c.grid.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double below = i + 1 < n ? x[i + 1] : c.grid.below_temperature;
        const double next = c.grid.conductance[i] * (x[i] - below);
        dx[i] = (down - next + (i + 1 == n ? c.grid.below_flux : 0.0)) / c.grid.capacity[i];
        down = next;
    }
    return 0;
}

}  // namespace

StageForcing FacetDay::air_at(double t) const {
    const double minute = std::clamp(t / 60.0, 0.0, double(air->size() - 1));
    const std::size_t i = std::min(std::size_t(minute), air->size() - 2);
    const double share = minute - double(i);
    const StageForcing &a = (*air)[i], &b = (*air)[i + 1];
    StageForcing now = a;
    const auto mix = [&](double& x, double to) { x += share * (to - x); };
    mix(now.sky_longwave, b.sky_longwave);
    mix(now.air.air_temperature, b.air.air_temperature);
    mix(now.air.neutral, b.air.neutral);
    mix(now.air.instability, b.air.instability);
    mix(now.air.heat_capacity, b.air.heat_capacity);
    mix(now.air.vapour_pressure, b.air.vapour_pressure);
    mix(now.air.latent, b.air.latent);
    return now;
}

double FacetDay::heat_at(double t, std::size_t passed) const {
    const std::size_t i = std::min(std::size_t(t / step), heat.size() - 2);
    double whole = 0.0, so_far = 0.0;
    std::size_t k = 0;
    for (const Jump& j : jump) {
        if (j.step != i) continue;
        whole += j.heat;
        if (k++ < passed) so_far += j.heat;
    }
    const double share = t / step - double(i);
    return heat[i] + share * (heat[i + 1] - heat[i] - whole) + so_far;
}

std::vector<double> periodic_start(const FacetDay& day) {
    const MaterialColumn& c = *day.column;
    const std::size_t n = c.grid.size();
    if (n + 1 > lanes) throw InputError("column_bench", "too many nodes for one batch");
    constexpr double fine = 20.0;
    MaterialColumn column = c;
    column.stage = make_stage(c.grid, sdirk_gamma * fine, c.reference);
    std::vector<double> x(n, day.air_at(0.0).air.air_temperature - c.reference);
    for (int newton = 0; newton < 6; ++newton) {
        // One lane from x, one each from x with a node warmed by half a kelvin.
        LayeredBatch batch;
        batch.resize(n, n + 1);
        batch.natural.fill(day.natural);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t l = 0; l <= n; ++l) {
                batch.state[i * lanes + l] = x[i] + (l == i + 1 ? 0.5 : 0.0);
            }
        }
        StepRecord record;
        double heat[2][lanes];
        for (double t = 0.0; t < 86400.0 - 1.0; t += fine) {
            AirFilm air[2];
            for (int k = 0; k < 2; ++k) {
                const double at = t + stage_share[std::size_t(k)] * fine;
                const StageForcing now = day.air_at(at);
                air[k] = now.air;
                std::size_t passed = 0;
                for (const FacetDay::Jump& j : day.jump) {
                    const double when = (double(j.step) + j.share) * day.step;
                    if (j.step == std::size_t(at / day.step) && when <= at) ++passed;
                }
                std::fill_n(heat[k], lanes,
                            day.heat_at(at, passed) + c.surface.emissivity * now.sky_longwave);
            }
            advance(column, {air[0], air[1]}, {heat[0], heat[1]}, batch, record);
        }
        Eigen::MatrixXd left = Eigen::MatrixXd::Identity(Eigen::Index(n), Eigen::Index(n));
        Eigen::VectorXd change(static_cast<Eigen::Index>(n));
        for (std::size_t i = 0; i < n; ++i) {
            const double* const row = batch.state.data() + i * lanes;
            change[Eigen::Index(i)] = row[0] - x[i];
            for (std::size_t j = 0; j < n; ++j) {
                left(Eigen::Index(i), Eigen::Index(j)) -= (row[j + 1] - row[0]) / 0.5;
            }
        }
        const Eigen::VectorXd move = left.fullPivLu().solve(change);
        for (std::size_t i = 0; i < n; ++i) x[i] += move[Eigen::Index(i)];
        if (move.cwiseAbs().maxCoeff() < 1e-6) break;
    }
    for (double& t : x) t += c.reference;
    return x;
}

std::vector<double> cvode_day(const FacetDay& day, std::vector<double>& state, double tolerance) {
    const auto n = static_cast<sunindextype>(state.size());
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    N_Vector y = N_VMake_Serial(n, state.data(), context);
    SUNMatrix matrix = SUNBandMatrix(n, 1, 1, context);
    SUNLinearSolver linear = SUNLinSol_Band(y, matrix, context);
    void* const solver = CVodeCreate(CV_BDF, context);
    Problem problem{day, 0.0, 0.0, 0.0, 1.0};
    CVodeInit(solver, derivative, 0.0, y);
    CVodeSStolerances(solver, tolerance, tolerance);
    CVodeSetLinearSolver(solver, linear, matrix);
    CVodeSetUserData(solver, &problem);
    CVodeSetMaxNumSteps(solver, 1000000);
    std::vector<double> surface{state[0]};
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < day.heat.size(); ++i) {
        double from = double(i) * day.step;
        const double end = from + day.step;
        std::size_t passed = 0;
        for (bool more = true; more;) {
            more = next < day.jump.size() && day.jump[next].step == i;
            const double to = more ? (double(i) + day.jump[next].share) * day.step : end;
            if (to > from) {
                // Both ends lie in this step: the later one just before it is over.
                problem.from = from;
                problem.length = to - from;
                problem.heat_0 = day.heat_at(from, passed);
                problem.heat_1 = day.heat_at(std::min(to, end - 1e-6), passed);
                CVodeSetStopTime(solver, to);
                double reached = from;
                if (CVode(solver, to, y, &reached, CV_NORMAL) < 0) {
                    throw InputError("column_bench", "CVODE gave up");
                }
                from = to;
            }
            if (more) {
                ++passed;
                ++next;
                CVodeReInit(solver, from, y);
            }
        }
        surface.push_back(N_VGetArrayPointer(y)[0]);
    }
    void* memory = solver;
    CVodeFree(&memory);
    SUNLinSolFree(linear);
    SUNMatDestroy(matrix);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return surface;
}

std::vector<double> euler_days(const FacetDay& day, int spin_up) {
    const MaterialColumn& c = *day.column;
    const std::size_t n = c.grid.size();
    const Stage stage = make_stage(c.grid, day.step, c.reference);
    double mean = 0.0;
    for (const StageForcing& f : *day.air) mean += f.air.air_temperature / double(day.air->size());
    std::vector<double> state(n * lanes, mean - c.reference), offset(n * lanes);
    std::vector<double> surface;
    double temperature = mean;
    for (int d = 0; d <= spin_up; ++d) {
        surface.assign(1, temperature);
        for (std::size_t i = 1; i < day.heat.size(); ++i) {
            double a, flux, slope;
            const StageForcing now = day.air_at(double(i) * day.step);
            const double heat = day.heat[i] + c.surface.emissivity * now.sky_longwave;
            eliminate(c.grid, stage, 1, state.data(), offset.data(), &a);
            solve_surface(now.air, {.count = 1,
                                    .heat = &heat,
                                    .natural = &day.natural,
                                    .a = &a,
                                    .b = stage.b,
                                    .reference = c.reference,
                                    .emissivity = c.surface.emissivity,
                                    .temperature = &temperature,
                                    .flux = &flux,
                                    .slope = &slope});
            state[0] = temperature - c.reference;
            for (std::size_t k = 1; k < n; ++k) {
                state[k * lanes] = stage.follow[k] * state[(k - 1) * lanes] + offset[k * lanes];
            }
            surface.push_back(temperature);
        }
    }
    return surface;
}

}  // namespace diurna
