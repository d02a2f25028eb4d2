#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "thermal/column/column.hpp"

namespace diurna {

// A target as one thermal network: facets that conduct through their thickness and along their
// sheet, and lumps (engine blocks, coolant, the air of a cabin) that have one temperature each. A
// facet's exchange with sun, sky and wind is computed by the caller; everything else here.

inline constexpr std::uint32_t no_number = 0xFFFFFFFFu;

/// Lateral conduction along a triangle of conductivity × thickness 1 W/K: the heat that leaves
/// through side a is Σ_b sideways(a, b) (T_facet − T_side b) [W]. The lowest mixed finite element
/// (Raviart & Thomas 1977, hybrid as in Arnold & Brezzi 1985): exact for temperatures that are
/// linear over the triangles, for any shape, and conservative for each. Packed 00 01 02 11 12 22.
using SidewaysFlow = std::array<double, 6>;

/// What all facets of one part share.
struct NetworkColumn {
    ColumnGrid grid;  // its last link leads to the bottom, if it has one
    /// [W K⁻¹] conductivity × thickness assigned to its outer and its inner end.
    std::array<double, 2> spread{};
};

/// Partners of a facet's inner end: the air of an enclosure, its radiant mean, with which it
/// exchanges σ radiant (T⁴ − T_star⁴), and touching facets.
enum Behind { behind_air, behind_star, behind_touched };
inline constexpr std::size_t behinds = 3;

/// A facet, its outer end first.
struct NetworkFacet {
    std::uint32_t column = 0;
    double area = 0.0;  // [m²]
    SidewaysFlow sideways{};
    /// (end) [side] index of the network's edges, which neighbours share; or no_number.
    std::array<std::array<std::uint32_t, 3>, 2> edge{
        {{no_number, no_number, no_number}, {no_number, no_number, no_number}}};
    std::array<std::uint32_t, behinds> lump{no_number, no_number, no_number};
    double film = 0.0;     // [W m⁻² K⁻¹] to the air behind
    double radiant = 0.0;  // 0 to slightly over 1: factor of σ T⁴, see radiant_share
    double contact = 0.0;  // [W m⁻² K⁻¹] to touching facets
    double open = 1.0;     // uncovered share of its outer face, which exchanges
};

/// Contact of an outer end with another: heat flows to an edge between them, which both share.
struct HeatTouch {
    std::uint32_t facet, edge;
    double conductance;  // [W K⁻¹] to the edge, twice that of the contact
};

/// One temperature. Without a capacity it is always in balance; a fixed one is given.
struct HeatLump {
    double capacity = 0.0;  // [J K⁻¹]
    bool fixed = false;
};
struct HeatLink {
    std::uint32_t a, b;  // lumps
    double conductance;  // [W K⁻¹]
};
/// A stream that carries heat in one direction: ṁ c (T_from − T_to) into `to`.
struct HeatStream {
    std::uint32_t from, to;  // lumps
    double conductance;      // [W K⁻¹] mass flow × heat capacity
};

struct HeatNetwork {
    std::vector<NetworkColumn> column;
    std::vector<NetworkFacet> facet;
    std::uint32_t edges = 0;
    std::vector<HeatTouch> touch;  // facet by facet, ascending
    std::vector<HeatLump> lump;
    std::vector<HeatLink> link;
    std::vector<HeatStream> stream;

    /// Index of a facet's first touch; those of the last end with `touch`.
    std::size_t first_touch(std::size_t f) const;
    const ColumnGrid& grid_of(std::size_t f) const { return column[facet[f].column].grid; }
};

/// Lateral conduction of a triangle from its sides' lengths [m] (side a is opposite corner a).
SidewaysFlow sideways_flow(const std::array<double, 3>& side, double area);

/// A triangle's column: a plate with less than 0.03 K between its faces at a few hundred W/m² is
/// one node; others have the column's own grid. `spread` follows from the layers, each assigned to
/// the end that is nearer by resistance.
///
/// bottom  boundary behind it, FixedFlux{0} for an enclosure or the open
NetworkColumn network_column(const std::vector<Layer>& layers, const Bottom& bottom,
                             const GridOptions& options = {});

/// The share of σ T⁴ that an inner face of an enclosure exchanges with the enclosure's radiant
/// mean: 1 / (1 / F + (1 − ε) / ε), F the factor of its plane by Carroll (1980, ASHRAE Trans. 86,
/// 1): F_i = 1 / (1 − A_i F_i / Σ A_j F_j). Exact for two planes and for cubes of black faces.
///
/// area        (plane) [m²]
/// returns     (plane) F
std::vector<double> carroll_factors(const std::vector<double>& area);
double radiant_share(double carroll_factor, double emissivity);

}  // namespace diurna
