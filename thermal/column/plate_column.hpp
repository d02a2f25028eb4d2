#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "thermal/column/column.hpp"
#include "thermal/column/step_weights.hpp"

namespace diurna {

/// A step of a plate with a film on each face. It has few nodes (thermal/column/column.hpp),
/// so all its eigenmodes are used; with u = q + film θ of each face linear in time over the
/// step,
///
///     x₁ = decay x₀ + Σ_k face_k (from u₀ₖ + to u₁ₖ),    θ_k = Σ face_k x,    k = front, back.
///
/// Valid for any thickness and conductivity: a sheet whose time constant is shorter than the step
/// follows its films immediately, and the mode between its faces only conducts heat through.
struct PlateStep {
    double step, reference;                   // [s], [K]
    std::array<double, 2> film;               // [W m⁻² K⁻¹] front, back
    std::vector<double> rate;                 // (mode) [s⁻¹]
    std::array<std::vector<double>, 2> face;  // (mode)
    std::vector<double> decay, from, to;      // (mode)
    std::array<double, 3> response;           // Σ to face face: front, across, back [K m² W⁻¹]
    Eigen::MatrixXd turn, into;               // (node, mode), (mode, node)

    std::size_t modes() const { return rate.size(); }
};
/// grid  of the plate; its link below the last node is ignored
PlateStep make_plate_step(const ColumnGrid& grid, double reference, double front_film,
                          double back_film, double step);

}  // namespace diurna
