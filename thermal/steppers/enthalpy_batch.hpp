#pragma once

#include <array>
#include <vector>

#include "thermal/kernels/enthalpy_kernel.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// Up to `enthalpy_lanes` facets of one material whose water freezes, or on which water and snow
/// lie: what PointFacet (thermal/point/point_facet.hpp) is one by one, for all surfaces without
/// leaves, schedules and regolith. Lanes beyond `count` copy the first.
struct EnthalpyBatch {
    using Lanes = std::array<double, enthalpy_lanes>;

    const ThermalSurface* surface = nullptr;
    const EnthalpyColumn* column = nullptr;
    std::size_t count = 0;
    std::array<NaturalFilm, enthalpy_lanes> natural{};
    std::array<StoreCapacity, enthalpy_lanes> capacity{};
    Lanes rain_share{};     // of rain on level open ground
    std::vector<double> u;  // [node][lane], see NonlinearColumn
    std::array<Standing, enthalpy_lanes> standing{};
    std::array<WaterCount, enthalpy_lanes> water{};
    std::array<StoreRates, enthalpy_lanes> rates{};  // of the last step
    Lanes snow_albedo{};                             // of snow that ages, or lies on the store
    Lanes skin{}, taken{};  // at the last step's end: [K], [W m⁻²] by the ground
    /// What the last step's surfaces were like.
    struct Met {
        Lanes wet_share{}, phase_film{}, frost_heat{}, water_heat{}, albedo{};
        Lanes cover{};  // [W m⁻² K⁻¹] of snow between skin and ground
        bool covered = false;
    } met;
    /// What the column makes of `columns` deviations of its start, [node][column][lane]; none if 0.
    std::size_t columns = 0;
    std::vector<double> map;
    double worst_closure = 0.0;  // |stored − in| / Σ|terms|, of any lane and step
    long long steps = 0, passes = 0, stages = 0;

    bool stores() const { return surface->store.capacity_mm > 0.0; }
};

/// What a step's two stages meet, at step · γ and at its end; [lane].
struct EnthalpyForcing {
    double duration = 0.0;  // [s]
    bool gentle = false;    // backward Euler in place of SDIRK2: the second stage alone
    std::array<AirFilm, 2> air{};
    double air_temperature = 0.0, rain_mm_h = 0.0;  // half way [K], of level open ground
    std::array<double, 2> measured_albedo{};        // NaN: the surface's own
    std::array<EnthalpyBatch::Lanes, 2> sunlight{}, longwave{};  // [W m⁻²] incident
    std::array<EnthalpyBatch::Lanes, 2> behind{};  // [W m⁻²] absorbed by plates' backs
    bool has_back = false;
};

/// One step. False: its equations are not solved, and the batch is as it was.
bool advance(const EnthalpyForcing& forcing, EnthalpyBatch& batch);

/// The conditions of one lane, for its terms by name: at the end of the last step as it met them,
/// or (`now`) as they are.
SurfaceConditions conditions_of(const EnthalpyBatch& batch, const EnthalpyForcing& forcing,
                                std::size_t lane, bool now = false);

}  // namespace diurna
