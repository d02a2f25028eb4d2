#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "thermal/solve/facet_point.hpp"

namespace diurna {

/// What all points of one material share that are stepped side by side.
struct PointColumn {
    NonlinearColumn column;
    EnthalpyColumn plain;
    /// The slowest deviations of the column, (node, k), orthonormal in heat; `weight` = C · slow.
    /// Empty where the span does not repeat.
    Eigen::MatrixXd slow, weight;
};
PointColumn point_column(const SolveState& solve, const MaterialColumn& material);

/// Whether a surface's points may be stepped side by side (thermal/steppers/enthalpy_batch.hpp):
/// all but leaves, regolith and schedules.
bool in_lanes(const ThermalSurface& surface);

/// Runs up to `enthalpy_lanes` points of one material through the span, side by side; a periodic
/// one until it closes, or eight times.
///
/// The period is found by Newton on the slowest deviations of the column alone, what is quicker
/// follows by itself (Lust, Roose, Spence & Champneys 1998, SIAM J. Sci. Comput. 19, 1188). A
/// point begins from its block's state. All have the air of one height, the middle of eight metres
/// (0.026 K of its ends).
///
/// weather  at the solve's instants
void run_point_group(const SolveState& solve, const Level& level, const PointColumn& column,
                     const std::vector<Forcing>& weather, std::span<FacetPoint* const> point);

/// [m] Which eight metres of height a facet lies in.
long height_slice(const SolveState& solve, std::size_t facet);

}  // namespace diurna
