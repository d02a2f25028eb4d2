#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "thermal/column/column.hpp"

namespace diurna {

/// A linear column as a few exponential modes, accurate for the surface temperature due to a flux
/// into the surface.
///
///     ẋ = −rate x + surface q,    θ(surface) = Σ surface x,    θ(depth) = Σ profile x
///
/// q [W m⁻²] is the flux into the column, θ = T − reference [K]. Input and output weights are the
/// same, so the impedance Σ surface² / (iω + rate) has positive residues and real poles at or left
/// of zero: it is passive for any flux.
///
/// Computed by Galerkin projection of a finely divided column (thermal/column/column.hpp) on its
/// steady states and its waves under a periodic flux (a rational Krylov space; Grimme 1997). The
/// impedance at each of those periods is matched with its derivative, the steady limit too, and
/// heat is conserved exactly, because the uniform temperature is in the space. The first period is
/// a day; each further one is that with the largest remaining error.
struct ReducedColumn {
    Eigen::VectorXd rate;       // (mode) [s⁻¹] ≥ 0, ascending
    Eigen::VectorXd surface;    // (mode) [K m W⁻¹ᐟ² ...] state scaled so that capacity is 1
    Eigen::VectorXd heat;       // (mode) stored heat = Σ heat x [J m⁻²]
    Eigen::MatrixXd profile;    // (node, mode) of the fine column
    std::vector<double> depth;  // (node) [m]
    double below = 0.0;         // [W m⁻² K⁻¹] link from the last node to the bottom, or 0
    double reference;           // [K] of θ; the bottom temperature, if it has one
    double flux_below = 0.0;    // [W m⁻²] from below; is added to the surface flux and adds
    Eigen::VectorXd excess;     // (node) [K] to the profile, zero at the surface

    Eigen::Index modes() const { return rate.size(); }
};

struct ReductionOptions {
    double largest_error = 0.003;   // see reduction_error
    double largest_kelvin = 0.1;    // [K] see surface_error
    double longest = 31 * 86400.0;  // [s] longest period considered; the steady limit is exact
    Eigen::Index most = 14;         // modes
    GridOptions grid{.first = 0.004, .growth = 0.1};
};

/// With as many modes as `largest_error` and `largest_kelvin` need. `reference` is used for columns
/// without a bottom temperature.
ReducedColumn reduce_column(std::span<const Layer> layers, const Bottom& bottom, double reference,
                            const ReductionOptions& options = {});

/// Surface temperature per flux into the column [m² K W⁻¹] at an angular frequency.
std::complex<double> impedance(const ReducedColumn& column, double frequency);
/// The same for the layers themselves, from the analytic solution of the heat equation (tanh per
/// layer), cut off at the depth of the grid options.
std::complex<double> impedance(std::span<const Layer> layers, const Bottom& bottom,
                               double frequency, const GridOptions& grid = {});
/// The largest difference of the two for periods from a minute to `longest` [s],
/// relative to the layers' impedance; for periods below an hour relative to that at an
/// hour.
double reduction_error(const ReducedColumn& column, std::span<const Layer> layers,
                       const Bottom& bottom, double longest, const GridOptions& grid = {});

/// Error of the modes' surface temperature [K] under extreme forcing: a flux of `swing` [W
/// m⁻²], half of full sun, at the worst period from a minute to `longest`, and a film of
/// radiation and calm air, `film` [W m⁻² K⁻¹]: swing |Z / (1 + film Z) − Z' / (1 + film Z')|. A
/// shadow's edge has all periods (its spectrum is proportional to 1/frequency), with a third of
/// its height.
double surface_error(const ReducedColumn& column, std::span<const Layer> layers,
                     const Bottom& bottom, double longest, const GridOptions& grid = {});

/// The column with a film h [W m⁻² K⁻¹] on its surface, driven by u = q + h θ: the modes then
/// include most of the feedback of the surface temperature, and decay as fast as the surface does.
/// turn (mode, mode): states of the open column = turn · states of the closed one.
struct ClosedColumn {
    double film;
    Eigen::VectorXd rate, surface;
    Eigen::MatrixXd turn;
};
ClosedColumn close_column(const ReducedColumn& column, double film);

}  // namespace diurna
