#include <algorithm>
#include <cmath>
#include <vector>

#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/steppers/layered_batch.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

void advance_plate(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
                   const std::array<const double*, 2>& heat, Batch& batch, StepRecord& record) {
    constexpr double settled = 1e-9;  // [K] of the back's last correction
    constexpr int most_rounds = 60;
    const ColumnGrid& grid = material.grid;
    const std::size_t n = grid.size();
    const double tau = material.stage.tau, step = tau / sdirk_gamma, reference = material.reference;
    std::vector<double> start(n), offset(n), follow(n), theta(n);
    record.slope = {};
    for (std::size_t l = 0; l < batch.count; ++l) {
        double surface = batch.temperature[l], in = 0.0, terms = 1e-3;
        for (std::size_t i = 0; i < n; ++i) start[i] = theta[i] = batch.state[i * lanes + l];
        for (int k = 0; k < 2; ++k) {
            double flux = 0.0, slope = 0.0, behind = 0.0;
            for (int round = 0; round < most_rounds; ++round) {
                const double guess = theta[n - 1] + reference;
                const SurfaceFlux back =
                    back_flux(air[k], batch.natural[l], material.surface.back->emissivity, guess);
                const double known = back.flux - back.slope * theta[n - 1];
                double pull = 0.0, push = 0.0;  // follow and offset of the node below
                for (std::size_t i = n - 1; i >= 1; --i) {
                    const double store = grid.capacity[i] / tau, up = grid.conductance[i - 1];
                    const bool last = i == n - 1;
                    const double down = last ? 0.0 : grid.conductance[i];
                    const double scale =
                        1.0 / (store + up + down * (1.0 - pull) - (last ? back.slope : 0.0));
                    offset[i] = (store * start[i] + down * push + (last ? known : 0.0)) * scale;
                    follow[i] = up * scale;
                    pull = follow[i];
                    push = offset[i];
                }
                const bool single = n == 1;
                const double store = grid.capacity[0] / tau;
                const double down = single ? 0.0 : grid.conductance[0];
                const double a = store * start[0] + down * push + (single ? known : 0.0);
                const double b = store + down * (1.0 - pull) - (single ? back.slope : 0.0);
                const SurfaceCount newton =
                    solve_surface(air[k], {.count = 1,
                                           .heat = heat[k] + l,
                                           .natural = &batch.natural[l],
                                           .a = &a,
                                           .b = b,
                                           .reference = reference,
                                           .emissivity = material.surface.emissivity,
                                           .temperature = &surface,
                                           .flux = &flux,
                                           .slope = &slope});
                ++record.stages;
                record.iterations += newton.iterations;
                record.worst_iterations = std::max(record.worst_iterations, newton.iterations);
                record.bisections += newton.bisections;
                theta[0] = surface - reference;
                for (std::size_t i = 1; i < n; ++i) theta[i] = follow[i] * theta[i - 1] + offset[i];
                const double moved = theta[n - 1] + reference - guess;
                behind = back.flux + back.slope * moved;
                if (std::abs(moved) < settled) break;
            }
            record.slope[k] += slope;
            const double weight = k == 0 ? 1.0 - sdirk_gamma : sdirk_gamma;
            in += weight * (flux + behind);
            terms += weight * (std::abs(heat[k][l]) + std::abs(flux) + std::abs(behind));
            if (k == 0) {
                constexpr double again = (1.0 - sdirk_gamma) / sdirk_gamma;
                for (std::size_t i = 0; i < n; ++i) {
                    const double old = batch.state[i * lanes + l];
                    start[i] = old + again * (theta[i] - old);
                }
            }
        }
        double stored = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            stored += grid.capacity[i] * (theta[i] - batch.state[i * lanes + l]);
        }
        batch.rate[l] = theta[0] - batch.state[l];
        batch.temperature[l] = surface;
        for (std::size_t i = 0; i < n; ++i) batch.state[i * lanes + l] = theta[i];
        record.worst_closure =
            std::max(record.worst_closure, std::abs(stored - step * in) / (step * terms));
    }
}

}  // namespace diurna
