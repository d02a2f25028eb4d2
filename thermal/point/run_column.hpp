#pragma once

#include <string>
#include <vector>

#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// One row of the result; fluxes are positive towards the surface [W m⁻²] and sum, with the
/// internal heat, to the storage of the surface node's half cell.
struct PointRow {
    Instant instant;
    double surface_temperature;  // [K]
    double absorbed_solar, longwave_in, longwave_out, sensible, latent, conducted;
    double back_temperature;    // [K]
    double ground_temperature;  // [K] below a canopy; else the surface
    double leaf_temperature;    // [K] of a canopy
    double water_mm, frost_mm;  // on the surface
    double melt;  // heat that melts snow or frost, mean since the previous row [W m⁻²]
    double depth_temperature;  // [K] at PointJob::depth
};

struct PointResult {
    std::vector<PointRow> row;  // at start, start + step, ... end
    WaterCount water;           // over the span, without spin-up
    bool has_back = false, has_canopy = false, has_store = false, has_melt = false;
    std::string note;                // quantities modelled because not measured
    int passes = 0;                  // of the spin-up
    double periodic_residual = 0.0;  // [K] worst node after a pass of it
    double periodic_error = 0.0;     // [K] distance from the period, worst node
    double standing_residual = 0.0;  // [mm] of water and frost: change over the last pass
    bool store_held = false;  // no day repeats these: the start is that after eight such days
    bool converged = true;    // temperatures repeat, to within PointJob::tolerance
    double worst_energy_closure = 0.0;  // |stored − in| / Σ|terms|, of any step
    long long steps = 0, rejected = 0;
    /// Steps with backward Euler at the shortest step, because the equations did not converge or
    /// the error stayed too large. Zero in normal use.
    int limited = 0;
    std::vector<double> depth, final_profile;  // (node) [m], ascending, the first 0; [K]
};

PointResult run_column(const PointJob& job);

}  // namespace diurna
