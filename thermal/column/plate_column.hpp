#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "thermal/column/column.hpp"
#include "thermal/column/step_weights.hpp"

namespace diurna {

/// A step of a plate closed by a film on each face. Its nodes (thermal/column/column.hpp) are few,
/// so all their eigenmodes are kept; with u = q + film θ of each face linear in time between the
/// ends,
///
///     x₁ = decay x₀ + Σ_k face_k (from u₀ₖ + to u₁ₖ),    θ_k = Σ face_k x,    k = front, back.
///
/// Right however thin and conductive the sheet is: one too quick for the step follows its films at
/// once, and the mode between its faces only carries the heat through.
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
/// grid  of the plate; what it has below its last node is skipped
PlateStep make_plate_step(const ColumnGrid& grid, double reference, double front_film,
                          double back_film, double step);

}  // namespace diurna
