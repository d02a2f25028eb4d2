#pragma once

#include <Eigen/Core>

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

}  // namespace diurna
