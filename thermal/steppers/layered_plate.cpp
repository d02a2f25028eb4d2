#include "thermal/steppers/layered_plate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

/// One plate's column within a stage: nodes relative to the reference.
struct Sheet {
    std::vector<double> start, theta;    // (node) [K] before and after the stage
    std::vector<double> offset, follow;  // (node) of the node above it
};

/// The surface node's equation, flux = b θ₀ − a, with all below it eliminated.
struct SurfaceNode {
    double a, b;
};
/// back  the flux into the last node, linearised about where it is
SurfaceNode eliminate_upward(const MaterialColumn& material, const SurfaceFlux& back,
                             Sheet& sheet) {
    const ColumnGrid& grid = material.grid;
    const std::size_t n = grid.size();
    const double tau = material.stage.tau;
    const double known = back.flux - back.slope * sheet.theta[n - 1];
    double pull = 0.0, push = 0.0;  // follow and offset of the node below
    for (std::size_t i = n - 1; i >= 1; --i) {
        const double store = grid.capacity[i] / tau, up = grid.conductance[i - 1];
        const bool last = i == n - 1;
        const double down = last ? 0.0 : grid.conductance[i];
        const double scale = 1.0 / (store + up + down * (1.0 - pull) - (last ? back.slope : 0.0));
        sheet.offset[i] = (store * sheet.start[i] + down * push + (last ? known : 0.0)) * scale;
        sheet.follow[i] = up * scale;
        pull = sheet.follow[i];
        push = sheet.offset[i];
    }
    const bool single = n == 1;
    const double store = grid.capacity[0] / tau;
    const double down = single ? 0.0 : grid.conductance[0];
    return {store * sheet.start[0] + down * push + (single ? known : 0.0),
            store + down * (1.0 - pull) - (single ? back.slope : 0.0)};
}

/// What reaches a plate's front in a stage, and its back.
struct Above {
    const AirFilm& air;
    NaturalFilm natural;
    double heat;  // [W m⁻²]
    BackFace back;
};
/// [W m⁻²] into the two faces at a stage's end, and d/dT of the front's.
struct PlateFaceFluxes {
    double front = 0.0, slope = 0.0, behind = 0.0;
    double taken = 0.0;  // [W m⁻²] through the front, by the column
};
/// surface  [K] a guess, then the root
PlateFaceFluxes solve_stage(const MaterialColumn& material, const Above& above, Sheet& sheet,
                            double& surface, StepRecord& record) {
    constexpr double settled = 1e-9;  // [K] of the back's last correction
    constexpr int most_rounds = 60;
    const std::size_t n = material.grid.size();
    const double reference = material.reference;
    std::vector<double>& theta = sheet.theta;
    PlateFaceFluxes fluxes;
    for (int round = 0; round < most_rounds; ++round) {
        const double guess = theta[n - 1] + reference;
        const SurfaceFlux back = back_flux(above.air, above.natural, above.back, guess);
        const SurfaceNode node = eliminate_upward(material, back, sheet);
        const SurfaceCount newton =
            solve_surface(above.air, {.count = 1,
                                      .heat = &above.heat,
                                      .natural = &above.natural,
                                      .a = &node.a,
                                      .b = node.b,
                                      .reference = reference,
                                      .emissivity = material.surface.emissivity,
                                      .temperature = &surface,
                                      .flux = &fluxes.front,
                                      .slope = &fluxes.slope});
        record.count(newton.iterations, newton.bisections);
        theta[0] = surface - reference;
        fluxes.taken = node.b * theta[0] - node.a;
        for (std::size_t i = 1; i < n; ++i) {
            theta[i] = sheet.follow[i] * theta[i - 1] + sheet.offset[i];
        }
        const double moved = theta[n - 1] + reference - guess;
        fluxes.behind = back.flux + back.slope * moved;
        if (std::abs(moved) < settled) break;
    }
    return fluxes;
}

}  // namespace

void advance_plate(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
                   const std::array<const double*, 2>& heat, LayeredBatch& batch,
                   StepRecord& record) {
    const ColumnGrid& grid = material.grid;
    const std::size_t n = grid.size();
    const double step = material.stage.tau / sdirk_gamma;
    Sheet sheet{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n),
                std::vector<double>(n)};
    record.slope = {};
    for (std::size_t l = 0; l < batch.count; ++l) {
        double surface = batch.temperature[l], in = 0.0, terms = 1e-3;
        for (std::size_t i = 0; i < n; ++i) {
            sheet.start[i] = sheet.theta[i] = batch.state[i * lanes + l];
        }
        for (std::size_t k = 0; k < 2; ++k) {
            const double emissivity = material.surface.back->emissivity;
            const BackFace back{
                emissivity,
                batch.behind[k] ? batch.behind[k][l] : absorbed_of_air(air[k], emissivity),
                batch.wet_behind};
            const PlateFaceFluxes fluxes = solve_stage(
                material, {air[k], batch.natural[l], heat[k][l], back}, sheet, surface, record);
            record.slope[k] += fluxes.slope;
            batch.taken[l] = fluxes.taken;
            const double weight = stage_weight[k];
            in += weight * (fluxes.front + fluxes.behind);
            terms +=
                weight * (std::abs(heat[k][l]) + std::abs(fluxes.front) + std::abs(fluxes.behind));
            for (std::size_t i = 0; k == 0 && i < n; ++i) {
                const double old = batch.state[i * lanes + l];
                sheet.start[i] = old + stage_onward * (sheet.theta[i] - old);
            }
        }
        double stored = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            stored += grid.capacity[i] * (sheet.theta[i] - batch.state[i * lanes + l]);
        }
        batch.rate[l] = sheet.theta[0] - batch.state[l];
        batch.temperature[l] = surface;
        for (std::size_t i = 0; i < n; ++i) batch.state[i * lanes + l] = sheet.theta[i];
        record.worst_closure =
            std::max(record.worst_closure, std::abs(stored - step * in) / (step * terms));
    }
}

}  // namespace diurna
