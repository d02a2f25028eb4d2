#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "thermal/column/column.hpp"

namespace diurna {

// A target as one body of heat: facets that conduct through their thickness and along their sheet,
// and lumps (engine blocks, coolant, the air of a cabin) that have one temperature each. What a
// facet exchanges with sun, sky and wind is its caller's; everything else stands here.

inline constexpr std::uint32_t no_number = 0xFFFFFFFFu;

/// Heat that spreads along a triangle of conductivity × thickness 1 W/K: what leaves through side a
/// is Σ_b sideways(a, b) (T_facet − T_side b) [W]. The lowest mixed finite element (Raviart &
/// Thomas 1977, hybrid as in Arnold & Brezzi 1985): exact for temperatures that are linear over the
/// triangles, whatever their shape, and closed for each. Packed 00 01 02 11 12 22.
using SidewaysFlow = std::array<double, 6>;

/// What all facets of one part share.
struct NetworkColumn {
    ColumnGrid grid;  // its last link leads to what lies below, if to anything
    /// [W K⁻¹] conductivity × thickness of what lies near its outer and its inner end.
    std::array<double, 2> spread{};
};

/// What a facet's inner end may have to do with: the air of an enclosure, its radiant mean, with
/// which it exchanges σ radiant (T⁴ − T_star⁴), and what it touches.
enum Behind { behind_air, behind_star, behind_touched };
inline constexpr std::size_t behinds = 3;

/// A facet, its outer end first.
struct NetworkFacet {
    std::uint32_t column = 0;
    double area = 0.0;  // [m²]
    SidewaysFlow sideways{};
    /// (end) [side] into the network's edges, which neighbours share; or no_number.
    std::array<std::array<std::uint32_t, 3>, 2> edge{
        {{no_number, no_number, no_number}, {no_number, no_number, no_number}}};
    std::array<std::uint32_t, behinds> lump{no_number, no_number, no_number};
    double film = 0.0;     // [W m⁻² K⁻¹] to the air behind
    double radiant = 0.0;  // 0 to 1 and a little more: of σ T⁴, see radiant_share
    double contact = 0.0;  // [W m⁻² K⁻¹] to what it touches
    double open = 1.0;     // share of its outer face that nothing lies on: what exchanges
};

/// An outer end that lies on another: heat goes to an edge between them, which the other has too.
struct HeatTouch {
    std::uint32_t facet, edge;
    double conductance;  // [W K⁻¹] to the edge, twice that of the contact
};

/// One temperature. Without a capacity it is in balance at any time; a fixed one is given.
struct HeatLump {
    double capacity = 0.0;  // [J K⁻¹]
    bool fixed = false;
};
struct HeatLink {
    std::uint32_t a, b;  // lumps
    double conductance;  // [W K⁻¹]
};
/// A stream that carries heat one way: ṁ c (T_from − T_to) into `to`.
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

    /// Where a facet's touches begin; those of the last end with `touch`.
    std::size_t first_touch(std::size_t f) const;
    const ColumnGrid& grid_of(std::size_t f) const { return column[facet[f].column].grid; }
};

/// The sideways flow of a triangle by the lengths of its sides [m] (side a is opposite corner a).
SidewaysFlow sideways_flow(const std::array<double, 3>& side, double area);

/// A triangle's column: a plate that a few hundred W/m² warm by less than 0.03 K from side to side
/// is one node; others have the column's own grid. `spread` follows from the layers, each at the
/// end that it is nearer to by resistance.
///
/// bottom  what lies behind it, FixedFlux{0} where that is an enclosure or the open
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
