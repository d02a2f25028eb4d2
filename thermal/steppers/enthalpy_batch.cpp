#include "thermal/steppers/enthalpy_batch.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/column/column.hpp"
#include "thermal/surface/canopy.hpp"

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;
using Lanes = EnthalpyBatch::Lanes;

/// What lies on the surfaces over a step, and what they are like then.
struct Covered {
    std::array<StoreRates, W> rates;
    std::array<Lying, W> lying;
    EnthalpyBatch::Met met;
};
constexpr double no_snow = 1e7;  // [W m⁻² K⁻¹] between a skin without snow and the ground

bool snow_lies(const ThermalSurface& surface) { return !surface.snow_albedo.has_value(); }

/// The balance's albedo where none is measured, of a surface as wet and as white.
double albedo_of(const EnthalpyBatch& batch, std::size_t l, double wet, double cover, double snow) {
    const ThermalSurface& surface = *batch.surface;
    if (surface.snow_albedo) return batch.snow_albedo[l];
    double albedo = surface.albedo;
    if (surface.store.wet_albedo >= 0.0) albedo += wet * (surface.store.wet_albedo - albedo);
    return albedo + cover * (snow - albedo);
}

void lie(const EnthalpyBatch& batch, double step, Covered& covered) {
    const ThermalSurface& surface = *batch.surface;
    EnthalpyBatch::Met& met = covered.met;
    met.covered = false;
    for (std::size_t l = 0; l < W; ++l) {
        const Standing& at = batch.standing[l];
        const StoreCapacity& capacity = batch.capacity[l];
        Lying& lying = covered.lying[l];
        if (batch.stores()) {
            lying = lying_over(at, capacity, covered.rates[l], lying.rain, lying.snow, step);
        }
        const SnowCover snow = snow_lies(surface)
                                   ? snow_cover(lying.middle.frost, surface.roughness_length)
                                   : SnowCover{};
        const double wet =
            capacity.any() ? std::min(1.0, lying.middle.water / capacity.water_mm) : 0.0;
        met.wet_share[l] = lying.wet_share;
        met.cover[l] = snow.conductance > 0.0 ? snow.conductance : no_snow;
        met.covered = met.covered || snow.conductance > 0.0;
        met.phase_film[l] = snow.phase_film;
        met.frost_heat[l] = (at.frost + capacity.caught * lying.snow) * heat_of_fusion / step;
        met.water_heat[l] = (at.water + lying.rain) * heat_of_fusion / step;
        const double white = aged_albedo({}, batch.snow_albedo[l], covered.rates[l].melting > 0.0,
                                         0.5 * lying.snow, 0.5 * step);
        met.albedo[l] = albedo_of(batch, l, wet, snow.share, white);
    }
}

/// Memory of a step, which is shorter than an allocation.
struct Memory {
    std::vector<double> by, target, work, begin, start, given;
    void fit(std::size_t nodes, std::size_t columns) {
        by.assign(nodes * W, 0.0);
        target.assign(nodes * W, 0.0);
        work.resize(3 * nodes * W);
        start.resize(nodes * columns * W);
        given.resize(nodes * columns * W);
    }
};

double heat_of(const EnthalpyNode& n, double u) {
    if (n.latent == 0.0) return n.thawed * u;
    const double most = n.drains ? 1e300 : 1.0;
    return n.frozen * std::min(u, 0.0) + n.latent * std::clamp(u, 0.0, most) +
           n.thawed * std::max(u - most, 0.0);
}
double gain_of(const EnthalpyNode& n, double u, double by) {
    return n.latent == 0.0 ? n.thawed * by : heat_of(n, u + by) - heat_of(n, u);
}
double heat_slope_of(const EnthalpyNode& n, double u) {
    if (n.latent == 0.0) return n.thawed;
    return u <= 0.0 ? n.frozen : (n.drains || u < 1.0 ? n.latent : n.thawed);
}

/// What a step leaves behind of its stages.
struct StageEnd {
    Lanes least_film, skin, flux, slope, below, below_slope, taken, heat;
};

/// The surface of a stage; the lanes it points to must live.
EnthalpySurface surface_of(const EnthalpyBatch& batch, const EnthalpyForcing& f, std::size_t k,
                           const Covered& covered, StageEnd& at) {
    const ThermalSurface& surface = *batch.surface;
    const double measured = f.measured_albedo[k];
    const double fullest = covered.met.covered ? fullest_film(f.air[k]) : 0.0;
    Lanes& heat = at.heat;
    for (std::size_t l = 0; l < W; ++l) {
        at.least_film[l] = covered.met.cover[l] < no_snow ? fullest : 0.0;
        const double albedo = std::isnan(measured) ? covered.met.albedo[l] : measured;
        heat[l] = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * f.sunlight[k][l] +
                  surface.emissivity * f.longwave[k][l] + surface.internal_heat;
    }
    return {.air = f.air[k],
            .natural = batch.natural.data(),
            .heat = heat.data(),
            .wet_share = covered.met.wet_share.data(),
            .frost_heat = covered.met.frost_heat.data(),
            .water_heat = covered.met.water_heat.data(),
            .phase_film = covered.met.phase_film.data(),
            .cover = covered.met.covered ? covered.met.cover.data() : nullptr,
            .least_film = at.least_film.data(),
            .emissivity = surface.emissivity,
            .evaporates = surface.evaporation.wetness > 0.0 || batch.stores(),
            .behind = f.has_back ? f.behind[k].data() : nullptr,
            .back_emissivity = surface.back ? surface.back->emissivity : 0.0};
}

/// Right-hand sides of the linearised stages: heat slopes times the map, then the second stage's.
void begin_map(const EnthalpyBatch& batch, Memory& memory) {
    const std::size_t row = batch.columns * W;
    for (std::size_t i = 0; i < batch.column->node.size(); ++i) {
        alignas(64) double slope[W];
        for (std::size_t l = 0; l < W; ++l) {
            slope[l] = heat_slope_of(batch.column->node[i], batch.u[i * W + l]);
        }
        const double* const map = batch.map.data() + i * row;
        double *const given = memory.given.data() + i * row, *const start =
                                                                 memory.start.data() + i * row;
        for (std::size_t j = 0; j < row; j += W) {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) given[j + l] = start[j + l] = slope[l] * map[j + l];
        }
    }
}
void go_on_map(const EnthalpyBatch& batch, const std::vector<double>& u, Memory& memory) {
    const std::size_t row = batch.columns * W;
    for (std::size_t i = 0; i < batch.column->node.size(); ++i) {
        alignas(64) double slope[W];
        for (std::size_t l = 0; l < W; ++l) {
            slope[l] = heat_slope_of(batch.column->node[i], u[i * W + l]);
        }
        double* const given = memory.given.data() + i * row;
        const double* const start = memory.start.data() + i * row;
        for (std::size_t j = 0; j < row; j += W) {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                given[j + l] =
                    start[j + l] + stage_onward * (slope[l] * given[j + l] - start[j + l]);
            }
        }
    }
}

/// Both stages under what lies on the surfaces; `flows` [lane] get what they do to it.
bool run_stages(const EnthalpyForcing& f, const Covered& covered, EnthalpyBatch& batch,
                Memory& memory, std::array<StageEnd, 2>& end, std::array<StoreFlows, W>& flows) {
    const EnthalpyColumn& column = *batch.column;
    const std::size_t n = column.node.size();
    const EnthalpyKernel& kernel = enthalpy_kernel();
    memory.fit(n, batch.columns);
    if (batch.columns > 0) begin_map(batch, memory);
    for (std::size_t l = 0; l < W; ++l) {
        flows[l] = {.rain = covered.lying[l].rain, .snow = covered.lying[l].snow};
    }
    Lanes skin = batch.skin;
    std::vector<double>& now = memory.begin;
    for (std::size_t k = f.gentle ? 1 : 0; k < 2; ++k) {
        StageEnd& at = end[k];
        const EnthalpySurface surface = surface_of(batch, f, k, covered, at);
        const EnthalpyStage stage{column,
                                  f.gentle ? f.duration : sdirk_gamma * f.duration,
                                  batch.u.data(),
                                  memory.target.data(),
                                  memory.by.data(),
                                  memory.work.data(),
                                  skin.data(),
                                  at.flux.data(),
                                  at.slope.data(),
                                  at.below.data(),
                                  at.below_slope.data(),
                                  at.taken.data()};
        const EnthalpyCount count = kernel.solve(surface, stage);
        batch.passes += count.passes;
        ++batch.stages;
        if (!count.solved) return false;
        at.skin = skin;
        if (batch.columns > 0) {
            now.resize(n * W);
            for (std::size_t i = 0; i < n * W; ++i) now[i] = batch.u[i] + memory.by[i];
            kernel.carry(stage, now.data(), batch.columns, memory.given.data());
            if (k == 0) go_on_map(batch, now, memory);
        }
        if (batch.stores()) {
            Lanes wet, melt;
            kernel.store(surface, skin.data(), wet.data(), melt.data());
            for (std::size_t l = 0; l < W; ++l) {
                add_stage({.weight = f.duration * (f.gentle ? 1.0 : stage_weight[k]),
                           .air_temperature = f.air[k].air_temperature,
                           .surface = skin[l],
                           .wet_share = covered.met.wet_share[l],
                           .wet_latent = wet[l],
                           .frost_melt = melt[l]},
                          flows[l]);
            }
        }
        for (std::size_t i = 0; k == 0 && i < n; ++i) {
            for (std::size_t l = 0; l < W; ++l) {
                const std::size_t at_node = i * W + l;
                memory.target[at_node] =
                    stage_onward * gain_of(column.node[i], batch.u[at_node], memory.by[at_node]);
            }
        }
    }
    return true;
}

/// Counts what is not closed, and lets the column take over where the step has led.
void arrive(const EnthalpyForcing& f, const std::array<StageEnd, 2>& end, EnthalpyBatch& batch,
            Memory& memory) {
    const EnthalpyColumn& column = *batch.column;
    for (std::size_t l = 0; l < batch.count; ++l) {
        double gained = 0.0, moved = 0.0, in = 0.0, through = 1e-3;
        for (std::size_t i = 0; i < column.node.size(); ++i) {
            const double gain = gain_of(column.node[i], batch.u[i * W + l], memory.by[i * W + l]);
            gained += gain;
            moved += std::abs(gain);
        }
        for (std::size_t k = f.gentle ? 1 : 0; k < 2; ++k) {
            const double weight = f.gentle ? 1.0 : stage_weight[k];
            in += weight * (end[k].flux[l] + end[k].below[l]);
            through += weight * (std::abs(end[k].flux[l]) + std::abs(end[k].below[l]) +
                                 2.0 * std::abs(end[k].heat[l]));
        }
        const double scale = f.duration * through + moved;
        batch.worst_closure =
            std::max(batch.worst_closure, std::abs(gained - f.duration * in) / scale);
    }
    for (std::size_t i = 0; i < column.node.size(); ++i) {
        const EnthalpyNode& node = column.node[i];
        for (std::size_t l = 0; l < W; ++l) {
            double& u = batch.u[i * W + l];
            u += memory.by[i * W + l];
            if (node.drains) u = std::min(u, node.held / node.latent);
        }
    }
    batch.skin = end[1].skin;
    batch.taken = end[1].taken;
    if (batch.columns > 0) std::swap(batch.map, memory.given);
}

/// The snow of the surfaces after a step: older, or new where none lies.
void age_snow(double step, const StageEnd& end, const std::array<StoreFlows, W>& flows,
              EnthalpyBatch& batch) {
    const ThermalSurface& surface = *batch.surface;
    const bool own = surface.snow_albedo.has_value();
    if (!own && !batch.stores()) return;
    const AgeingAlbedo law = surface.snow_albedo.value_or(AgeingAlbedo{});
    for (std::size_t l = 0; l < W; ++l) {
        double& albedo = batch.snow_albedo[l];
        if (!own && batch.standing[l].frost <= 0.0) {
            albedo = law.fresh;
            continue;
        }
        const bool melting = own ? end.skin[l] >= zero_celsius : flows[l].melt > 0.0;
        albedo = aged_albedo(law, albedo, melting, flows[l].snow, step);
    }
}

}  // namespace

bool advance(const EnthalpyForcing& f, EnthalpyBatch& batch) {
    constexpr int most_attempts = 6;
    static thread_local Memory memory;
    Covered covered;
    covered.rates = batch.rates;
    const double snowing = snow_share(f.air_temperature);
    for (std::size_t l = 0; l < W; ++l) {
        const double fallen =
            batch.rain_share[l] * std::max(0.0, f.rain_mm_h) * f.duration / 3600.0;
        covered.lying[l].middle = batch.standing[l];
        covered.lying[l].snow = snowing * fallen;
        covered.lying[l].rain = fallen - covered.lying[l].snow;
    }
    std::array<StageEnd, 2> end;
    std::array<StoreFlows, W> flows;
    for (int attempt = 0;; ++attempt) {
        lie(batch, f.duration, covered);
        if (!run_stages(f, covered, batch, memory, end, flows)) return false;
        if (!batch.stores() || attempt == most_attempts) break;
        bool settled = true;
        for (std::size_t l = 0; l < W; ++l) {
            const StoreRates found = flows[l].rates(f.duration);
            const Lying& lying = covered.lying[l];
            settled = settled && alike(lying_over(batch.standing[l], batch.capacity[l], found,
                                                  lying.rain, lying.snow, f.duration),
                                       lying, batch.capacity[l]);
            covered.rates[l] = attempt < 3 ? found : middle_of(covered.rates[l], found);
        }
        if (settled) break;
    }
    arrive(f, end, batch, memory);
    for (std::size_t l = 0; batch.stores() && l < W; ++l) {
        batch.standing[l] =
            stored_after(batch.standing[l], flows[l], batch.capacity[l], batch.water[l]);
        batch.rates[l] = flows[l].rates(f.duration);
    }
    age_snow(f.duration, end[1], flows, batch);
    batch.met = covered.met;
    ++batch.steps;
    return true;
}

SurfaceConditions conditions_of(const EnthalpyBatch& batch, const EnthalpyForcing& f, std::size_t l,
                                bool now) {
    const ThermalSurface& surface = *batch.surface;
    const Standing& at = batch.standing[l];
    EnthalpyBatch::Met met = batch.met;
    if (now) {
        const StoreCapacity& capacity = batch.capacity[l];
        const SnowCover snow = batch.stores() && snow_lies(surface)
                                   ? snow_cover(at.frost, surface.roughness_length)
                                   : SnowCover{};
        const double wet = capacity.any() ? std::min(1.0, at.water / capacity.water_mm) : 0.0;
        met.wet_share[l] = mean_wet_share(at.water + at.frost, 0.0, 0.0, capacity.water_mm);
        met.cover[l] = snow.conductance;
        met.covered = snow.conductance > 0.0;
        met.phase_film[l] = snow.phase_film;
        met.frost_heat[l] = met.covered ? melts_at_once : 0.0;
        met.water_heat[l] = 0.0;
        met.albedo[l] = albedo_of(batch, l, wet, snow.share, batch.snow_albedo[l]);
    }
    const double measured = f.measured_albedo[1];
    const double albedo = std::isnan(measured) ? met.albedo[l] : measured;
    SurfaceConditions c;
    c.air = f.air[1];
    c.natural = batch.natural[l];
    c.absorbed_solar = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * f.sunlight[1][l];
    c.longwave_in = f.longwave[1][l];
    c.emissivity = surface.emissivity;
    c.internal = surface.internal_heat;
    c.wet_share = met.wet_share[l];
    c.stores = batch.stores();
    c.frost_heat = met.frost_heat[l];
    c.water_heat = met.water_heat[l];
    c.phase_film = met.phase_film[l];
    c.snow_conductance = met.covered && met.cover[l] < no_snow ? met.cover[l] : 0.0;
    return c;
}

}  // namespace diurna
