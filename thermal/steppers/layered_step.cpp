#include "thermal/steppers/layered_step.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/steppers/layered_plate.hpp"

namespace diurna {

namespace {

/// A batch within a step. `start` and `offset` [node][lane] are memory that outlives
/// it: a step is shorter than an allocation.
struct Way {
    double* start;                      // what the second stage sets out from
    double* offset;                     // of the nodes, eliminated upward
    alignas(64) double flux[2][lanes];  // [W m⁻²] at the surface, per stage
    alignas(64) double in[lanes];       // [W m⁻²] through both ends, by the first stage
    alignas(64) double stored[lanes];   // [J m⁻²]

    explicit Way(std::size_t nodes) {
        static thread_local std::vector<double> start_store, offset_store;
        start_store.resize(std::max(start_store.size(), nodes * lanes));
        offset_store.resize(start_store.size());
        start = start_store.data();
        offset = offset_store.data();
    }
};

/// Heat into the last node from below, were it at the reference [W m⁻²].
double driven_from_below(const MaterialColumn& material) {
    const ColumnGrid& grid = material.grid;
    return grid.conductance.back() * (grid.below_temperature - material.reference) +
           grid.below_flux;
}

/// What reaches the surfaces at stage k.
struct Above {
    std::size_t k;
    const AirFilm& air;
    const double* heat;
};
/// The stage's surfaces, the columns below eliminated.
void solve_stage(const MaterialColumn& material, const Above& above, LayeredBatch& batch, Way& way,
                 StepRecord& record) {
    const std::size_t k = above.k;
    const double* const from = k == 0 ? batch.state.data() : way.start;
    // Newton starts where the surface would be if it went on as it has.
    for (std::size_t l = 0; l < batch.count; ++l) {
        const double before = batch.state[l] + material.reference;
        const double rate = k == 0 ? batch.rate[l] : (batch.temperature[l] - before) / sdirk_gamma;
        batch.temperature[l] = before + stage_share[k] * rate;
    }
    alignas(64) double a[lanes], slope[lanes];
    eliminate(material.grid, material.stage, batch.count, from, way.offset, a);
    const SurfaceCount newton = solve_surface(above.air, {.count = batch.count,
                                                          .heat = above.heat,
                                                          .natural = batch.natural.data(),
                                                          .a = a,
                                                          .b = material.stage.b,
                                                          .reference = material.reference,
                                                          .emissivity = material.surface.emissivity,
                                                          .temperature = batch.temperature.data(),
                                                          .flux = way.flux[k],
                                                          .slope = slope});
    record.count(newton.iterations, newton.bisections);
    double sum = 0.0;
    for (std::size_t l = 0; l < batch.count; ++l) {
        sum += slope[l];
        batch.taken[l] = material.stage.b * (batch.temperature[l] - material.reference) - a[l];
    }
    record.slope[k] = sum;
}

/// The nodes follow the first stage's surfaces: what the second sets out from.
void set_out_again(const MaterialColumn& material, const LayeredBatch& batch, Way& way) {
    const std::size_t n = material.grid.size(), count = batch.count;
    const double* const state = batch.state.data();
    double* const start = way.start;
    double carried[lanes];
#pragma omp simd
    for (std::size_t l = 0; l < count; ++l) {
        carried[l] = batch.temperature[l] - material.reference;
        start[l] = state[l] + stage_onward * (carried[l] - state[l]);
    }
    for (std::size_t i = 1; i < n; ++i) {
        const double follow = material.stage.follow[i];
        const double *add = way.offset + i * lanes, *old = state + i * lanes;
        double* next = start + i * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < count; ++l) {
            carried[l] = follow * carried[l] + add[l];
            next[l] = old[l] + stage_onward * (carried[l] - old[l]);
        }
    }
    const double last = material.grid.conductance[n - 1], driven = driven_from_below(material);
#pragma omp simd
    for (std::size_t l = 0; l < count; ++l) {
        way.in[l] = stage_weight[0] * (way.flux[0][l] + driven - last * carried[l]);
    }
}

/// The nodes follow the second stage's surfaces: the step's end.
void arrive(const MaterialColumn& material, LayeredBatch& batch, Way& way) {
    const std::size_t n = material.grid.size(), count = batch.count;
    double* const state = batch.state.data();
    double* const stored = way.stored;
    const double capacity_above = material.grid.capacity[0];
    double carried[lanes];
#pragma omp simd
    for (std::size_t l = 0; l < count; ++l) {
        carried[l] = batch.temperature[l] - material.reference;
        batch.rate[l] = carried[l] - state[l];
        stored[l] = capacity_above * (carried[l] - state[l]);
        state[l] = carried[l];
    }
    for (std::size_t i = 1; i < n; ++i) {
        const double follow = material.stage.follow[i], capacity = material.grid.capacity[i];
        const double* add = way.offset + i * lanes;
        double* old = state + i * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < count; ++l) {
            carried[l] = follow * carried[l] + add[l];
            stored[l] += capacity * (carried[l] - old[l]);
            old[l] = carried[l];
        }
    }
}

/// |stored − in| / Σ|terms| dt of the worst lane, or `worst` if that is more.
double closure(const MaterialColumn& material, const double* heat, const LayeredBatch& batch,
               const Way& way, double worst) {
    const std::size_t n = material.grid.size();
    const double step = material.stage.tau / sdirk_gamma;
    const double last = material.grid.conductance[n - 1], driven = driven_from_below(material);
    const double* const bottom = batch.state.data() + (n - 1) * lanes;
    const double* const flux = way.flux[1];
    const double radiation = material.surface.emissivity * stefan_boltzmann;
#pragma omp simd reduction(max : worst)
    for (std::size_t l = 0; l < batch.count; ++l) {
        const double whole = way.in[l] + stage_weight[1] * (flux[l] + driven - last * bottom[l]);
        const double t = batch.temperature[l];
        const double terms = std::abs(heat[l]) + radiation * t * t * t * t + std::abs(flux[l]) +
                             std::abs(driven) + 1e-3;
        worst = std::max(worst, std::abs(way.stored[l] - step * whole) / (step * terms));
    }
    return worst;
}

}  // namespace

void advance(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
             const std::array<const double*, 2>& heat, LayeredBatch& batch, StepRecord& record) {
    if (material.surface.back) return advance_plate(material, air, heat, batch, record);
    Way way(material.grid.size());
    solve_stage(material, {0, air[0], heat[0]}, batch, way, record);
    set_out_again(material, batch, way);
    solve_stage(material, {1, air[1], heat[1]}, batch, way, record);
    arrive(material, batch, way);
    record.worst_closure = closure(material, heat[1], batch, way, record.worst_closure);
}

double settle(const MaterialColumn& material, const AirFilm& air, const double* heat,
              LayeredBatch& batch) {
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
    // A surface that loses next to nothing has its balance beyond all reason.
    constexpr double hotter_than_air = 1500.0;  // [K]
    for (std::size_t l = 0; l < count; ++l) {
        batch.temperature[l] =
            std::min(batch.temperature[l], air.air_temperature + hotter_than_air);
    }
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
