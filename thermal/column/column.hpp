#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// How finely a column is cut, in skin depths l = √(k P / (π ρc)) of each layer for the period P.
struct GridOptions {
    double period = 86400.0;  // [s] that the skin depth refers to
    double first = 0.05;      // spacing at the surface [skin depths]: a quarter of one for 1 h
    double growth = 0.22;     // increase of the spacing per skin depth downward, per spacing
    double deepest = 12.0;    // [skin depths] below which the column is cut off as insulated
};

/// A layered column as nodes and links (finite volumes around nodes). Node 0 is at the surface and
/// has the capacity of its half cell; nodes are on every interface, so no link crosses one.
///
/// Second order in the spacing: under a daily wave of flux the surface amplitude of a half-space is
/// 0.40 % too small and 0.42 min late with the default options, 20 nodes; 0.05 % and 0.21 min with
/// a growth of 0.05, 53 nodes (tests/thermal/column_test.cpp).
struct ColumnGrid {
    std::vector<double> depth;        // (node) [m]
    std::vector<double> capacity;     // (node) [J m⁻² K⁻¹]
    std::vector<double> conductance;  // (node) [W m⁻² K⁻¹] of the link from node i to i + 1;
                                      // the last one: to the bottom, or 0
    double below_temperature = 0.0;   // [K] at the end of the last link
    double below_flux = 0.0;          // [W m⁻²] upward into the last node

    std::size_t size() const { return depth.size(); }
    double total_capacity() const;
};

ColumnGrid column_grid(std::span<const Layer> layers, const Bottom& bottom,
                       const GridOptions& options = {});

/// Lanes of facets computed side by side. State arrays are [node][lane].
inline constexpr std::size_t lanes = 32;

/// L-stable, stiffly accurate SDIRK2 (Alexander 1977), γ = 1 − 1/√2: two implicit stages of γ·step.
inline constexpr double sdirk_gamma = 0.29289321881345247560;
/// Times of its stages as shares of the step, weights of their fluxes, and the factor of the second
/// stage's start: T + onward (T₁ − T).
inline constexpr std::array<double, 2> stage_share{sdirk_gamma, 1.0};
inline constexpr std::array<double, 2> stage_weight{1.0 - sdirk_gamma, sdirk_gamma};
inline constexpr double stage_onward = (1.0 - sdirk_gamma) / sdirk_gamma;

/// One implicit stage of a linear column, (C/τ)(T − T*) = conduction + below + surface flux,
/// eliminated from the bottom upward. The remaining equation at the surface is
///
///     flux into the column = b θ₀ − a,    θ = T − reference.
///
/// The coefficients are shared by all facets of a material. Temperatures are relative to
/// `reference`, which gains a digit in the energy balance.
struct Stage {
    double tau;                    // [s] γ·step
    double b;                      // [W m⁻² K⁻¹]
    double surface_store;          // C₀/τ
    std::vector<double> remember;  // (node) weight of its T*
    std::vector<double> lift;      // (node) weight of the nodes eliminated below it
    std::vector<double> follow;    // (node) weight of the node above it
    double below;                  // added to the last node [K]
};
Stage make_stage(const ColumnGrid& grid, double tau, double reference);

/// Upward elimination over `count` lanes: fills `offset` [node][lane] and a[lane] from `start`
/// (T* − reference) [node][lane].
void eliminate(const ColumnGrid& grid, const Stage& stage, std::size_t count, const double* start,
               double* offset, double* a);

/// A linear column's steady state, T(depth) for a surface temperature, and its conduction: flux
/// into the column = conductance (T_s − temperature).
struct SteadyColumn {
    double conductance;          // [W m⁻² K⁻¹]; 0 if the bottom is a flux
    double temperature;          // [K]
    double flux;                 // [W m⁻²] upward through a column of given flux
    std::vector<double> share;   // (node) 1 at the surface: T = T_s share + T_below (1 − share)
    std::vector<double> excess;  // (node) [K] added by the flux from below
};
SteadyColumn steady_column(const ColumnGrid& grid);

}  // namespace diurna
