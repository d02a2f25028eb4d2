#pragma once

#include <array>
#include <vector>

#include "thermal/kernels/enthalpy_kernel.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// `enthalpy_lanes` facets of one material with freezing water, or with water and snow on them: the
/// same as PointFacet (thermal/point/point_facet.hpp), for all surfaces without leaves, schedules
/// and regolith. Each lane has its own time, air and length of step.
struct EnthalpyBatch {
    using Lanes = std::array<double, enthalpy_lanes>;

    const ThermalSurface* surface = nullptr;
    const EnthalpyColumn* column = nullptr;
    std::array<NaturalFilm, enthalpy_lanes> natural{};
    std::array<StoreCapacity, enthalpy_lanes> capacity{};
    Lanes rain_share{};     // share of rain on level open ground
    double fullest = 0.0;   // fullest_share of the surface (thermal/surface/canopy.hpp)
    std::vector<double> u;  // [node][lane], see NonlinearColumn
    std::array<Standing, enthalpy_lanes> standing{};
    std::array<WaterCount, enthalpy_lanes> water{};
    std::array<StoreRates, enthalpy_lanes> rates{};  // of the last step
    Lanes snow_albedo{};                             // of snow that ages, or lies on the store
    alignas(64) Lanes skin{};                        // [K] at the last step's end
    Lanes taken{};                                   // [W m⁻²] into the ground then
    /// Surface conditions of the last step.
    struct Met {
        alignas(64) Lanes wet_share{}, phase_film{}, frost_heat{}, water_heat{}, albedo{};
        alignas(64) Lanes cover{};  // [W m⁻² K⁻¹] of snow between skin and ground
        bool covered = false;       // any lane
    } met;
    /// Number of deviations, [node][column][lane], to which the column's step is applied; 0: none.
    std::size_t columns = 0;
    std::vector<float> map;
    Lanes worst_closure{};  // |stored − in| / Σ|terms|, of any step

    bool stores() const { return surface->store.capacity_mm > 0.0; }
};

/// Inputs of a step's two stages, at step · γ and at its end; [lane].
struct EnthalpyForcing {
    using Lanes = EnthalpyBatch::Lanes;
    Lanes duration{};                           // [s]
    std::array<bool, enthalpy_lanes> gentle{};  // backward Euler instead of SDIRK2
    std::array<LaneAir, 2> air{};
    Lanes air_temperature{}, rain_mm_h{};         // mid-step [K], of level open ground
    std::array<Lanes, 2> measured_albedo{};       // NaN: the surface's own
    std::array<Lanes, 2> sunlight{}, longwave{};  // [W m⁻²] incident
    std::array<Lanes, 2> behind{};                // [W m⁻²] absorbed by plates' backs
    bool has_back = false;
};
using LaneMask = std::array<bool, enthalpy_lanes>;

}  // namespace diurna
