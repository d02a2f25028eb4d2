#pragma once

#include <cstddef>

#include "thermal/surface/frost.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

inline constexpr std::size_t enthalpy_lanes = 8;

/// The air over every lane, for one kind of surface [lane]. Value by value: loops that copy a whole
/// AirFilm are not vectorised.
struct LaneAir {
    using Lane = double[enthalpy_lanes];
    alignas(64) Lane temperature, neutral, instability, least;
    alignas(64) Lane heat_capacity, vapour_pressure, latent;
    alignas(64) Lane of_ice;  // heat of sublimation over that of vaporisation
    alignas(64) Lane conduct, sixth, quarter, third, laminar, turbulent, edge, warming;
    double a = 0.0, c = 0.0, s = 0.0, resistance = 0.0, wetness = 0.0;  // of the surface
    double roughness = 1.0;
    bool quadratic = false;
    FilmKind kind = FilmKind::ground;

    void put(std::size_t l, const AirFilm& air) {
        temperature[l] = air.air_temperature;
        neutral[l] = air.neutral;
        instability[l] = air.instability;
        least[l] = air.least;
        heat_capacity[l] = air.heat_capacity;
        vapour_pressure[l] = air.vapour_pressure;
        latent[l] = air.latent;
        of_ice[l] = ice_over_water(air.air_temperature);
        a = air.a;
        c = air.c;
        s = air.s;
        resistance = air.resistance;
        wetness = air.wetness;
        kind = air.kind;
        if (kind == FilmKind::ground || kind == FilmKind::sheltered_ground) return;
        conduct[l] = air.plate.conduct;
        sixth[l] = air.plate.sixth;
        quarter[l] = air.plate.quarter;
        third[l] = air.plate.third;
        laminar[l] = air.plate.laminar;
        turbulent[l] = air.plate.turbulent;
        edge[l] = air.plate.edge;
        warming[l] = air.plate.warming;
        roughness = air.plate.roughness;
        quadratic = air.plate.quadratic;
    }
    [[gnu::always_inline]] AirFilm operator()(std::size_t l) const {
        return {.air_temperature = temperature[l],
                .neutral = neutral[l],
                .instability = instability[l],
                .a = a,
                .c = c,
                .s = s,
                .least = least[l],
                .heat_capacity = heat_capacity[l],
                .vapour_pressure = vapour_pressure[l],
                .latent = latent[l],
                .resistance = resistance,
                .wetness = wetness,
                .kind = kind,
                .plate = {.conduct = conduct[l],
                          .sixth = sixth[l],
                          .quarter = quarter[l],
                          .third = third[l],
                          .laminar = laminar[l],
                          .turbulent = turbulent[l],
                          .edge = edge[l],
                          .warming = warming[l],
                          .roughness = roughness,
                          .quadratic = quadratic}};
    }
};

}  // namespace diurna
