#include "thermal/heat_balance.hpp"

#include <algorithm>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

constexpr double coldest = 1.0, hottest = 5000.0;  // [K] bracket
constexpr double settled = 1e-6;                   // [K] of the last correction
constexpr int most_iterations = 80;                // bisection alone needs 53 to its last bit

template <bool Plate, bool Wet>
SurfaceCount newton(const AirFilm& air, const SurfaceLanes& s) {
    const VapourTable& table = vapour_table();
    const double radiation = s.emissivity * stefan_boltzmann;
    double low[lanes], high[lanes];
    std::fill_n(low, s.count, coldest);
    std::fill_n(high, s.count, hottest);
    SurfaceCount count;
    double correction = hottest;
    while (correction > settled && count.iterations < most_iterations) {
        correction = 0.0;
        double left = 0.0;
#pragma omp simd reduction(max : correction) reduction(+ : left)
        for (std::size_t l = 0; l < s.count; ++l) {
            const double t = s.temperature[l];
            const Film film = Plate ? plate_film(air, s.natural[l], t) : ground_film(air, t);
            const double cube = radiation * t * t * t;
            double flux = s.heat[l] - cube * t - film.h * (t - air.air_temperature);
            double slope = -4.0 * cube - film.h - film.rise;
            if (Wet) {
                const LatentHeat latent = latent_heat(air, table, film, t);
                flux += latent.flux;
                slope += latent.slope;
            }
            const double excess = flux + s.a[l] - s.b * (t - s.reference);
            low[l] = excess > 0.0 ? t : low[l];
            high[l] = excess < 0.0 ? t : high[l];
            const double newton_step = excess / (s.b - slope);
            const double wanted = t + newton_step;
            const bool outside = !(wanted >= low[l] && wanted <= high[l]);
            const double next = outside ? 0.5 * (low[l] + high[l]) : wanted;
            s.temperature[l] = next;
            s.flux[l] = flux + slope * (next - t);
            s.slope[l] = slope;
            correction = std::max(correction, std::abs(next - t));
            left += outside ? 1.0 : 0.0;
        }
        count.bisections += static_cast<std::size_t>(left);
        ++count.iterations;
    }
    return count;
}

}  // namespace

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
        balance.latent = latent_heat(air, vapour_table(), film, temperature).flux;
    }
    balance.internal = internal;
    return balance;
}

SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface) {
    const bool wet = air.wetness > 0.0;
    if (air.plate)
        return wet ? newton<true, true>(air, surface) : newton<true, false>(air, surface);
    return wet ? newton<false, true>(air, surface) : newton<false, false>(air, surface);
}

}  // namespace diurna
