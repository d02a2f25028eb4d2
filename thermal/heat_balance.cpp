#include "thermal/heat_balance.hpp"

#include <algorithm>
#include <cmath>

#include "materials/units.hpp"
#include "thermal/surface_kernel.hpp"

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

namespace {

const SurfaceKernel& kernel() {
    static const bool wide =
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl");
    return wide ? surface_avx512 : surface_avx2;
}

}  // namespace

SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface) {
    return kernel().solve(air, surface);
}

SurfaceCount solve_surface_near(const AirFilm& air, const SurfaceLanes& surface) {
    constexpr double near = 1e-4;  // [K]
    if (air.plate) return solve_surface(air, surface);
    double guess[lanes];
    std::copy_n(surface.temperature, surface.count, guess);
    const double last = kernel().two_steps(air, surface);
    if (last <= near) return {.iterations = 2, .bisections = 0};
    if (last > 1.0) std::copy_n(guess, surface.count, surface.temperature);
    SurfaceCount count = solve_surface(air, surface);
    count.iterations += 2;
    return count;
}

}  // namespace diurna
