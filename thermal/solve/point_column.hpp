#pragma once

#include <Eigen/Core>

#include "thermal/solve/facet_point.hpp"

namespace diurna {

/// Data shared by all points of one material that are stepped in lanes.
struct PointColumn {
    NonlinearColumn column;
    EnthalpyColumn plain;
    /// The slowest deviations of the column, (node, k), orthonormal in heat; `weight` = C · slow.
    /// Empty if the span is not periodic.
    Eigen::MatrixXd slow, weight;
};
PointColumn point_column(const SolveState& solve, const MaterialColumn& material);

/// Whether a surface's points can be stepped in lanes (thermal/steppers/enthalpy_batch.hpp): all
/// except leaves, regolith and schedules.
bool in_lanes(const ThermalSurface& surface);

}  // namespace diurna
