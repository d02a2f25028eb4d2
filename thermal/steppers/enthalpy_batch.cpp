#include "thermal/steppers/enthalpy_batch.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/column/column.hpp"
#include "thermal/steppers/lying_lanes.hpp"

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;
using Lanes = EnthalpyBatch::Lanes;

/// Memory of a step, which is shorter than an allocation.
struct Memory {
    std::vector<double> by, target, work, end;
    void fit(std::size_t nodes) {
        by.assign(nodes * W, 0.0);
        target.assign(nodes * W, 0.0);
        work.resize(3 * nodes * W);
        end.resize(nodes * W);
    }
};

/// Heat of a node from u = 0 on; one law holds for nodes with water and without.
struct NodeHeat {
    double frozen, latent, thawed, melted;
    explicit NodeHeat(const EnthalpyNode& n)
        : frozen(n.latent == 0.0 ? n.thawed : n.frozen),
          latent(n.latent),
          thawed(n.thawed),
          melted(n.latent == 0.0 ? 0.0
                 : n.drains      ? 1e300
                                 : 1.0) {}
    double of(double u) const {
        return frozen * std::min(u, 0.0) + latent * std::min(std::max(u, 0.0), melted) +
               thawed * std::max(u - melted, 0.0);
    }
    double gain(double u, double by) const {
        const double through = of(u + by) - of(u);
        return latent == 0.0 ? thawed * by : through;
    }
};

/// What a step leaves behind of its stages.
struct StageEnd {
    alignas(64) Lanes melt, tau, weight, least_film, skin, flux, slope, below,
        below_slope, taken, heat, solved;
};

/// The surface of a stage; the lanes it points to must live.
EnthalpySurface surface_of(const EnthalpyBatch& batch, const EnthalpyForcing& f, std::size_t k,
                           const Covered& covered, StageEnd& at) {
    const ThermalSurface& surface = *batch.surface;
    const LaneAir& air = f.air[k];
    const double share = batch.fullest;
    const bool sheltered = air.kind == FilmKind::sheltered_ground;
    for (std::size_t l = 0; l < W; ++l) {
        const bool stable = covered.met.cover[l] < no_snow && air.instability[l] > 0.0;
        const double neutral = air.neutral[l] * (sheltered ? batch.natural[l].laminar : 1.0);
        at.least_film[l] = stable && share > 0.0 ? neutral * share + air.least[l] : 0.0;
        const double measured = f.measured_albedo[k][l];
        const double albedo = std::isnan(measured) ? covered.met.albedo[l] : measured;
        at.heat[l] = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * f.sunlight[k][l] +
                     surface.emissivity * f.longwave[k][l] + surface.internal_heat;
    }
    return {.air = &air,
            .natural = batch.natural.data(),
            .heat = at.heat.data(),
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

EnthalpyStage stage_of(const EnthalpyBatch& batch, Lanes& skin, Memory& memory, StageEnd& at) {
    return {*batch.column,    at.tau.data(),      batch.u.data(),        memory.target.data(),
            memory.by.data(), memory.work.data(), skin.data(),           at.flux.data(),
            at.slope.data(),  at.below.data(),    at.below_slope.data(), at.taken.data(),
            at.solved.data()};
}

/// How long the stages of each lane are, and what they count for.
void set_stages(const EnthalpyForcing& f, std::array<StageEnd, 2>& end) {
    for (std::size_t l = 0; l < W; ++l) {
        const double part = sdirk_gamma * f.duration[l];
        end[0].tau[l] = part;
        end[1].tau[l] = f.gentle[l] ? f.duration[l] : part;
        end[0].weight[l] = f.gentle[l] ? 0.0 : stage_weight[0];
        end[1].weight[l] = f.gentle[l] ? 1.0 : stage_weight[1];
    }
}

/// The second stage sets out above the first's gain; gentle lanes as if there had been none.
void go_on(const EnthalpyForcing& f, const EnthalpyBatch& batch, Lanes& skin, Memory& memory) {
    alignas(64) Lanes onward;
    bool gentle = false;
    for (std::size_t l = 0; l < W; ++l) {
        onward[l] = f.gentle[l] ? 0.0 : stage_onward;
        gentle = gentle || f.gentle[l];
    }
    for (std::size_t i = 0; i < batch.column->node.size(); ++i) {
        const NodeHeat heat(batch.column->node[i]);
        const double *const u = batch.u.data() + i * W, *const by = memory.by.data() + i * W;
        double* const target = memory.target.data() + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) target[l] = onward[l] * heat.gain(u[l], by[l]);
    }
    for (std::size_t l = 0; gentle && l < W; ++l) {
        if (!f.gentle[l]) continue;
        skin[l] = batch.skin[l];
        for (std::size_t i = 0; i < batch.column->node.size(); ++i) {
            memory.by[i * W + l] = memory.target[i * W + l] = 0.0;
        }
    }
}

/// Both stages under what lies on the surfaces; `flows` [lane] get what they do to it.
LaneMask run_stages(const EnthalpyForcing& f, const Covered& covered, EnthalpyBatch& batch,
                    Memory& memory, std::array<StageEnd, 2>& end,
                    std::array<StoreFlows, W>& flows) {
    const EnthalpyKernel& kernel = enthalpy_kernel();
    memory.fit(batch.column->node.size());
    set_stages(f, end);
    for (std::size_t l = 0; l < W; ++l) {
        flows[l] = {.rain = covered.lying[l].rain, .snow = covered.lying[l].snow};
    }
    alignas(64) Lanes skin = batch.skin;
    LaneMask solved;
    solved.fill(true);
    for (std::size_t k = 0; k < 2; ++k) {
        StageEnd& at = end[k];
        const EnthalpySurface surface = surface_of(batch, f, k, covered, at);
        kernel.solve(surface, stage_of(batch, skin, memory, at));
        at.skin = skin;
        for (std::size_t l = 0; l < W; ++l) {
            solved[l] = solved[l] && (at.solved[l] > 0.0 || (k == 0 && f.gentle[l]));
        }
        if (batch.stores()) {
            alignas(64) Lanes wet;
            kernel.store(surface, skin.data(), wet.data(), at.melt.data());
            for (std::size_t l = 0; l < W; ++l) {
                if (!solved[l] || at.weight[l] == 0.0) continue;
                add_stage({.weight = f.duration[l] * at.weight[l],
                           .air_temperature = f.air[k].air_temperature[l],
                           .surface = skin[l],
                           .wet_share = covered.met.wet_share[l],
                           .wet_latent = wet[l],
                           .frost_melt = at.melt[l]},
                          flows[l]);
            }
        }
        if (k == 0) go_on(f, batch, skin, memory);
    }
    return solved;
}

/// Counts what is not closed.
void count_closure(const EnthalpyForcing& f, const std::array<StageEnd, 2>& end,
                   const Lanes& arrives, const Memory& memory, EnthalpyBatch& batch) {
    const EnthalpyColumn& column = *batch.column;
    alignas(64) Lanes gained{}, moved{};
    for (std::size_t i = 0; i < column.node.size(); ++i) {
        const NodeHeat heat(column.node[i]);
        const double *const u = batch.u.data() + i * W, *const by = memory.by.data() + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            const double gain = heat.gain(u[l], by[l]);
            gained[l] += gain;
            moved[l] += std::abs(gain);
        }
    }
    for (std::size_t l = 0; l < W; ++l) {
        double in = 0.0, through = 1e-3;
        for (const StageEnd& at : end) {
            in += at.weight[l] * (at.flux[l] + at.below[l]);
            through += at.weight[l] *
                       (std::abs(at.flux[l]) + std::abs(at.below[l]) + 2.0 * std::abs(at.heat[l]));
        }
        const double scale = f.duration[l] * through + moved[l];
        const double open = std::abs(gained[l] - f.duration[l] * in) / scale;
        if (arrives[l] > 0.0) batch.worst_closure[l] = std::max(batch.worst_closure[l], open);
    }
}

/// Lets the columns take over where the step has led.
void arrive(const EnthalpyForcing& f, std::array<StageEnd, 2>& end, const LaneMask& solved,
            EnthalpyBatch& batch, Memory& memory) {
    const EnthalpyColumn& column = *batch.column;
    alignas(64) Lanes arrives;
    for (std::size_t l = 0; l < W; ++l) arrives[l] = solved[l] ? 1.0 : 0.0;
    count_closure(f, end, arrives, memory, batch);
    for (std::size_t i = 0; i < column.node.size(); ++i) {
        const EnthalpyNode& node = column.node[i];
        const double most = node.drains ? node.held / node.latent : 1e300;
        const double *const u = batch.u.data() + i * W, *const by = memory.by.data() + i * W;
        double* const to = memory.end.data() + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            to[l] = arrives[l] > 0.0 ? std::min(u[l] + by[l], most) : u[l];
        }
    }
    if (batch.columns > 0) {
        // One implicit step in place of the two stages: what it misses of them Newton makes up.
        const EnthalpyStage stage = stage_of(batch, end[1].skin, memory, end[1]);
        enthalpy_kernel().carry(stage, f.duration.data(), memory.end.data(), arrives.data(),
                                batch.columns, batch.map.data());
    }
    std::swap(batch.u, memory.end);
    for (std::size_t l = 0; l < W; ++l) {
        if (!solved[l]) continue;
        batch.skin[l] = end[1].skin[l];
        batch.taken[l] = end[1].taken[l];
    }
}

void take_met(const Covered& covered, const LaneMask& solved, EnthalpyBatch& batch) {
    EnthalpyBatch::Met& met = batch.met;
    for (std::size_t l = 0; l < W; ++l) {
        if (!solved[l]) continue;
        met.wet_share[l] = covered.met.wet_share[l];
        met.phase_film[l] = covered.met.phase_film[l];
        met.frost_heat[l] = covered.met.frost_heat[l];
        met.water_heat[l] = covered.met.water_heat[l];
        met.albedo[l] = covered.met.albedo[l];
        met.cover[l] = covered.met.cover[l];
    }
}

}  // namespace

LaneMask advance(const EnthalpyForcing& f, EnthalpyBatch& batch) {
    constexpr int most_attempts = 6;
    static thread_local Memory memory;
    Covered covered = begin_lying(f, batch);
    std::array<StageEnd, 2> end;
    std::array<StoreFlows, W> flows;
    LaneMask solved;
    for (int attempt = 0;; ++attempt) {
        lie(batch, f, covered);
        solved = run_stages(f, covered, batch, memory, end, flows);
        if (!batch.stores() || attempt == most_attempts) break;
        if (settle_rates(f, batch, flows, solved, attempt, covered)) break;
    }
    arrive(f, end, solved, batch, memory);
    for (std::size_t l = 0; l < W; ++l) {
        if (!solved[l]) continue;
        if (batch.stores()) {
            batch.standing[l] =
                stored_after(batch.standing[l], flows[l], batch.capacity[l], batch.water[l]);
            batch.rates[l] = flows[l].rates(f.duration[l]);
        }
        age_snow(f.duration[l], end[1].skin[l], flows[l], l, batch);
    }
    take_met(covered, solved, batch);
    return solved;
}

SurfaceConditions conditions_of(const EnthalpyBatch& batch, const EnthalpyForcing& f, std::size_t l,
                                bool now) {
    const ThermalSurface& surface = *batch.surface;
    const EnthalpyBatch::Met& met = batch.met;
    const Standing& at = batch.standing[l];
    const double measured = f.measured_albedo[1][l];
    SurfaceConditions c;
    double albedo = met.albedo[l];
    if (now) {
        const StoreCapacity& capacity = batch.capacity[l];
        const SnowCover snow = batch.stores() && snow_lies(surface)
                                   ? snow_cover(at.frost, surface.roughness_length)
                                   : SnowCover{};
        const double wet = capacity.any() ? std::min(1.0, at.water / capacity.water_mm) : 0.0;
        c.wet_share = mean_wet_share(at.water + at.frost, 0.0, 0.0, capacity.water_mm);
        c.snow_conductance = snow.conductance;
        c.phase_film = snow.phase_film;
        c.frost_heat = snow.conductance > 0.0 ? melts_at_once : 0.0;
        albedo = albedo_of(batch, l, wet, snow.share, batch.snow_albedo[l]);
    } else {
        c.wet_share = met.wet_share[l];
        c.snow_conductance = met.cover[l] < no_snow ? met.cover[l] : 0.0;
        c.phase_film = met.phase_film[l];
        c.frost_heat = met.frost_heat[l];
        c.water_heat = met.water_heat[l];
    }
    if (!std::isnan(measured)) albedo = measured;
    c.air = f.air[1](l);
    c.natural = batch.natural[l];
    c.absorbed_solar = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * f.sunlight[1][l];
    c.longwave_in = f.longwave[1][l];
    c.emissivity = surface.emissivity;
    c.internal = surface.internal_heat;
    c.stores = batch.stores();
    return c;
}

}  // namespace diurna
