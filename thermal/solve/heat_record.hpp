#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "thermal/heat_flux_field.hpp"
#include "thermal/solve/solve_state.hpp"
#include "thermal/steppers/mode_forcing.hpp"
#include "thermal/surface/heat_balance.hpp"

namespace diurna {

/// The heat balance of every facet at some of a solve's instants, recorded in the last pass at the
/// end of its steps.
class HeatRecord {
 public:
    /// steps  indices of the instants, ascending
    HeatRecord(const SolveState& solve, const std::vector<std::size_t>& steps);

    bool wants(std::size_t i) const { return row_[i] >= 0; }
    /// For one facet at instant i. From different threads for different facets.
    ///
    /// balance  with all terms, `conducted` too
    /// melting  [W m⁻²] used by melting frost
    void put(std::size_t i, std::size_t facet, const HeatBalance& balance, double melting = 0.0);

    const HeatFluxField& field() const { return field_; }

 private:
    HeatFluxField field_;
    std::vector<long> row_;  // (instant) of the field, or −1
};

/// Conditions of a block's surfaces at the end of a step.
struct BlockSurfaces {
    AirOver air;
    const double* heat;               // [lane] absorbed sun and longwave, internal [W m⁻²]
    const double* temperature;        // [lane] [K]
    std::span<const double> taken{};  // [lane] into the columns [W m⁻²]; empty: at the start of
                                      // a run, where it equals the surface flux
};
/// Records a block's balance at instant i, if requested.
void record_block(SolveState& solve, const Block& block, const Kind& kind, std::size_t i,
                  const BlockSurfaces& surfaces);
/// Records that of the back of a facet solved as a point.
///
/// absorbed  [W m⁻²] of sun and longwave
void record_point_back(const SolveState& solve, const Kind& kind, const Block& block,
                       std::size_t lane, std::size_t i, double absorbed, double kelvin);
/// Records that of a block's backs; the column receives their flux.
void record_backs(SolveState& solve, const Block& block, std::size_t i,
                  const BlockSurfaces& surfaces);

}  // namespace diurna
