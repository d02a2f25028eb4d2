#include "thermal/surface/heat_balance.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/surface_kernel.hpp"

namespace diurna {

double HeatBalance::sum() const {
    return absorbed_solar + longwave_in + longwave_out + sensible + latent + internal + conducted;
}

HeatBalance heat_balance(const AirFilm& air, NaturalFilm natural, double emissivity,
                         double absorbed_solar, double longwave_in, double internal,
                         double temperature) {
    const Film film =
        air.plate ? plate_film(air, natural, temperature) : ground_film(air, temperature);
    HeatBalance balance;
    balance.absorbed_solar = absorbed_solar;
    balance.longwave_in = emissivity * longwave_in;
    balance.longwave_out = -emissivity * stefan_boltzmann * power4(temperature);
    balance.sensible = -film.h * (temperature - air.air_temperature);
    if (air.wetness > 0.0) {
        balance.latent = latent_heat(air, film, temperature).flux;
    }
    balance.internal = internal;
    return balance;
}

bool wide_vectors() {
    static const bool wide =
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl");
    return wide;
}

SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface) {
    return (wide_vectors() ? surface_avx512 : surface_avx2).solve(air, surface);
}

}  // namespace diurna
