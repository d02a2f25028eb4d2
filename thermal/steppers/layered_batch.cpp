#include "thermal/steppers/layered_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/surface_kernel.hpp"

namespace diurna {

MaterialColumn material_column(const ThermalSurface& surface, const StepSetup& setup,
                               const LouisForm* louis) {
    // Behind a plate a typical film stands in the grid, for first guesses and the period's matrix;
    // its steps take the true one.
    constexpr double film_behind = 15.0;
    const Bottom bottom =
        surface.back ? Bottom{Interior{setup.reference, film_behind}} : surface.bottom;
    MaterialColumn material{
        .surface = surface,
        .louis = louis ? *louis
                       : louis_form(surface.roughness_length, surface.heat_roughness_length,
                                    setup.wind_height, setup.air_height),
        .grid = column_grid(surface.layers, bottom, setup.grid),
        .stage = {},
        .reference = setup.reference,
        .substeps = 0};
    constexpr double typical_film = 25.0;  // [W m⁻² K⁻¹] radiation and air together
    double share;
    do {
        ++material.substeps;
        const double step = setup.step / material.substeps;
        share = typical_film / make_stage(material.grid, step, setup.reference).b;
    } while (share > setup.largest_share && material.substeps < setup.most_substeps);
    material.substeps *= setup.refinement;
    material.stage =
        make_stage(material.grid, sdirk_gamma * setup.step / material.substeps, setup.reference);
    return material;
}

void Batch::resize(std::size_t nodes, std::size_t facets) {
    assert(facets <= lanes);
    count = facets;
    state.assign(nodes * lanes, 0.0);
}

void StepRecord::merge(const StepRecord& other) {
    worst_closure = std::max(worst_closure, other.worst_closure);
    stages += other.stages;
    iterations += other.iterations;
    worst_iterations = std::max(worst_iterations, other.worst_iterations);
    bisections += other.bisections;
}

void advance(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
             const std::array<const double*, 2>& heat, Batch& batch, StepRecord& record) {
    if (material.surface.back) return advance_plate(material, air, heat, batch, record);
    constexpr double again = (1.0 - sdirk_gamma) / sdirk_gamma;
    const ColumnGrid& grid = material.grid;
    const Stage& stage = material.stage;
    const std::size_t n = grid.size(), count = batch.count;
    // Memory that outlives the call: a step is shorter than an allocation.
    static thread_local std::vector<double> start_store, offset_store;
    start_store.resize(std::max(start_store.size(), n * lanes));
    offset_store.resize(start_store.size());
    double* const start = start_store.data();
    double* const offset = offset_store.data();
    double* const state = batch.state.data();
    alignas(64) double a[lanes], flux[2][lanes], slope[lanes], stored[lanes], in[lanes];

    for (int k = 0; k < 2; ++k) {
        // Newton starts where the surface would be if it went on as it has.
        for (std::size_t l = 0; l < count; ++l) {
            const double before = state[l] + material.reference;
            const double rate =
                k == 0 ? batch.rate[l] : (batch.temperature[l] - before) / sdirk_gamma;
            batch.temperature[l] = before + stage_share[k] * rate;
        }
        eliminate(grid, stage, count, k == 0 ? state : start, offset, a);
        const SurfaceCount newton =
            solve_surface(air[k], {.count = count,
                                   .heat = heat[k],
                                   .natural = batch.natural.data(),
                                   .a = a,
                                   .b = stage.b,
                                   .reference = material.reference,
                                   .emissivity = material.surface.emissivity,
                                   .temperature = batch.temperature.data(),
                                   .flux = flux[k],
                                   .slope = slope});
        ++record.stages;
        record.iterations += newton.iterations;
        record.worst_iterations = std::max(record.worst_iterations, newton.iterations);
        record.bisections += newton.bisections;
        record.slope[k] = 0.0;
        for (std::size_t l = 0; l < count; ++l) record.slope[k] += slope[l];

        double carried[lanes];
        if (k == 0) {
#pragma omp simd
            for (std::size_t l = 0; l < count; ++l) {
                carried[l] = batch.temperature[l] - material.reference;
                start[l] = state[l] + again * (carried[l] - state[l]);
            }
            for (std::size_t i = 1; i < n; ++i) {
                const double follow = stage.follow[i];
                const double *add = offset + i * lanes, *old = state + i * lanes;
                double* next = start + i * lanes;
#pragma omp simd
                for (std::size_t l = 0; l < count; ++l) {
                    carried[l] = follow * carried[l] + add[l];
                    next[l] = old[l] + again * (carried[l] - old[l]);
                }
            }
            const double last = grid.conductance[n - 1];
            const double driven =
                last * (grid.below_temperature - material.reference) + grid.below_flux;
#pragma omp simd
            for (std::size_t l = 0; l < count; ++l) {
                in[l] = (1.0 - sdirk_gamma) * (flux[0][l] + driven - last * carried[l]);
            }
        } else {
#pragma omp simd
            for (std::size_t l = 0; l < count; ++l) {
                carried[l] = batch.temperature[l] - material.reference;
                batch.rate[l] = carried[l] - state[l];
                stored[l] = grid.capacity[0] * (carried[l] - state[l]);
                state[l] = carried[l];
            }
            for (std::size_t i = 1; i < n; ++i) {
                const double follow = stage.follow[i], capacity = grid.capacity[i];
                const double* add = offset + i * lanes;
                double* old = state + i * lanes;
#pragma omp simd
                for (std::size_t l = 0; l < count; ++l) {
                    carried[l] = follow * carried[l] + add[l];
                    stored[l] += capacity * (carried[l] - old[l]);
                    old[l] = carried[l];
                }
            }
        }
    }

    const double step = stage.tau / sdirk_gamma;
    const double last = grid.conductance[n - 1];
    const double driven = last * (grid.below_temperature - material.reference) + grid.below_flux;
    const double* bottom = state + (n - 1) * lanes;
    const double radiation = material.surface.emissivity * stefan_boltzmann;
    double worst = record.worst_closure;
#pragma omp simd reduction(max : worst)
    for (std::size_t l = 0; l < count; ++l) {
        const double whole = in[l] + sdirk_gamma * (flux[1][l] + driven - last * bottom[l]);
        const double t = batch.temperature[l];
        const double terms = std::abs(heat[1][l]) + radiation * t * t * t * t +
                             std::abs(flux[1][l]) + std::abs(driven) + 1e-3;
        worst = std::max(worst, std::abs(stored[l] - step * whole) / (step * terms));
    }
    record.worst_closure = worst;
}

double settle(const MaterialColumn& material, const AirFilm& air, const double* heat,
              Batch& batch) {
    const std::size_t n = material.grid.size(), count = batch.count;
    const SteadyColumn steady = steady_column(material.grid);
    double a[lanes], flux[lanes], slope[lanes];
    for (std::size_t l = 0; l < count; ++l) {
        a[l] = steady.conductance * (steady.temperature - material.reference) + steady.flux;
        batch.temperature[l] = air.air_temperature;
    }
    solve_surface(air, {.count = count,
                        .heat = heat,
                        .natural = batch.natural.data(),
                        .a = a,
                        .b = steady.conductance,
                        .reference = material.reference,
                        .emissivity = material.surface.emissivity,
                        .temperature = batch.temperature.data(),
                        .flux = flux,
                        .slope = slope});
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t l = 0; l < count; ++l) {
            const double surface = batch.temperature[l] - material.reference;
            batch.state[i * lanes + l] =
                surface * steady.share[i] + steady.excess[i] +
                (steady.temperature - material.reference) * (1.0 - steady.share[i]);
        }
    }
    double film = 0.0;
    for (std::size_t l = 0; l < count; ++l) film -= slope[l];
    return film;
}

}  // namespace diurna
