#pragma once

#include <cstddef>

#include "thermal/kernels/film_lanes.hpp"
#include "thermal/surface/frost.hpp"

namespace diurna {

inline constexpr std::size_t enthalpy_lanes = 8;

/// The air over every lane, for one kind of surface.
struct LaneAir : FilmLanes<enthalpy_lanes, Lanes<enthalpy_lanes>> {
    Lanes<enthalpy_lanes> of_ice;  // heat of sublimation over that of vaporisation

    void put(std::size_t l, const AirFilm& air) {
        of_ice[l] = ice_over_water(air.air_temperature);
        FilmLanes::put(l, air);
    }
};

}  // namespace diurna
