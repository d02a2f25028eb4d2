#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "thermal/column/column.hpp"

namespace diurna {

/// A linear column as a few exponential modes, exact where it matters: the temperature that a flux
/// into the surface makes there.
///
///     ẋ = −rate x + surface q,    θ(surface) = Σ surface x,    θ(depth) = Σ profile x
///
/// q [W m⁻²] goes into the column, θ = T − reference [K]. The same numbers lead in and out, so the
/// impedance Σ surface² / (iω + rate) has positive residues and real poles at or left of zero: it
/// takes heat as any body does, whatever flux it is given.
///
/// Found by Galerkin's projection of a finely cut column (thermal/column/column.hpp) on its steady
/// states and its waves under a periodic flux (a rational Krylov space; Grimme 1997). The impedance
/// of each of those periods is met with its derivative, the steady limit too, and heat is kept
/// exactly, for the even temperature is in the space. The first period is a day; each further one
/// is that with the largest error left.
struct ReducedColumn {
    Eigen::VectorXd rate;       // (mode) [s⁻¹] ≥ 0, ascending
    Eigen::VectorXd surface;    // (mode) [K m W⁻¹ᐟ² ...] state scaled so that capacity is 1
    Eigen::VectorXd heat;       // (mode) stored heat = Σ heat x [J m⁻²]
    Eigen::MatrixXd profile;    // (node, mode) of the fine column
    std::vector<double> depth;  // (node) [m]
    double below = 0.0;       // [W m⁻² K⁻¹] link from the last node to what lies below, or 0
    double reference;         // [K] of θ; what lies below, if anything does
    double flux_below = 0.0;  // [W m⁻²] from below; it counts as flux into the surface and adds
    Eigen::VectorXd excess;   // (node) [K] to the profile, none at the surface

    Eigen::Index modes() const { return rate.size(); }
};

struct ReductionOptions {
    double largest_error = 0.003;   // see reduction_error
    double largest_kelvin = 0.1;    // [K] see surface_error
    double longest = 31 * 86400.0;  // [s] period up to which it counts; the steady limit is exact
    Eigen::Index most = 14;         // modes
    GridOptions grid{.first = 0.004, .growth = 0.1};
};

/// As many modes as `largest_error` and `largest_kelvin` take. `reference` stands for columns
/// closed below.
ReducedColumn reduce_column(std::span<const Layer> layers, const Bottom& bottom, double reference,
                            const ReductionOptions& options = {});

/// Surface temperature per flux into the column [m² K W⁻¹] at an angular frequency.
std::complex<double> impedance(const ReducedColumn& column, double frequency);
/// The same of the layers themselves, from the heat equation's own solution (tanh per layer), cut
/// off where the grid options cut them off.
std::complex<double> impedance(std::span<const Layer> layers, const Bottom& bottom,
                               double frequency, const GridOptions& grid = {});
/// The largest difference of the two for periods from a minute to `longest` [s], relative to the
/// layers' impedance, for periods below an hour relative to that of an hour: what a kelvin is worth
/// there.
double reduction_error(const ReducedColumn& column, std::span<const Layer> layers,
                       const Bottom& bottom, double longest, const GridOptions& grid = {});

/// What the modes' surface is off by [K] under the harshest light: a flux of `swing` [W m⁻²], half
/// of full sun, at whichever period from a minute to `longest` it does most, and a film of
/// radiation and calm air, `film` [W m⁻² K⁻¹]: swing |Z / (1 + film Z) − Z' / (1 + film Z')|. A
/// shadow's edge holds every period alike (its spectrum goes as one over frequency), with a third
/// of its height.
double surface_error(const ReducedColumn& column, std::span<const Layer> layers,
                     const Bottom& bottom, double longest, const GridOptions& grid = {});

/// The column with a film h [W m⁻² K⁻¹] on its surface, driven by u = q + h θ: most of what the
/// surface answers to its own warming is then in the modes, and they decay as fast as it does.
/// turn (mode, mode): states of the open column = turn · states of the closed one.
struct ClosedColumn {
    double film;
    Eigen::VectorXd rate, surface;
    Eigen::MatrixXd turn;
};
ClosedColumn close_column(const ReducedColumn& column, double film);

}  // namespace diurna
