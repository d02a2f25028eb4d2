#include "thermal/weather/clear_sky.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

double precipitable_water_cm(const AirState& air) {
    return 46.5 * (air.vapour_pressure / 100.0) / air.temperature;
}

Sunlight bird_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                        double water_cm, const ClearSky& sky) {
    if (sun_elevation_deg <= 0.0) return {0.0, 0.0};
    const double zenith_deg = 90.0 - sun_elevation_deg;
    const double cosine = std::sin(radians(sun_elevation_deg));
    const double mass = 1.0 / (cosine + 0.15 * std::pow(93.885 - zenith_deg, -1.25));
    const double pressure_mass = mass * pressure / 101325.0;
    const double top = solar_constant / (distance_au * distance_au);

    // Bird's depth of Rayleigh scattering turns back beyond 13 air masses (sun below 4°); from 10
    // on it follows the slope of Kasten's (1996, Solar Energy 56, 239).
    const double thin = std::min(pressure_mass, 10.0);
    const double rayleigh =
        std::exp(-0.0903 * std::pow(thin, 0.84) * (1.0 + thin - std::pow(thin, 1.01)) -
                 0.0156 * (pressure_mass - thin));
    const double o = sky.ozone_cm * mass;
    const double ozone = 1.0 - 0.1611 * o * std::pow(1.0 + 139.48 * o, -0.3035) -
                         0.002715 * o / (1.0 + 0.044 * o + 0.0003 * o * o);
    const double mixed = std::exp(-0.0127 * std::pow(pressure_mass, 0.26));
    const double w = water_cm * mass;
    const double water = 1.0 - 2.4959 * w / (std::pow(1.0 + 79.034 * w, 0.6828) + 6.385 * w);
    const double depth = 0.2758 * sky.aerosol_380nm + 0.35 * sky.aerosol_500nm;
    const double aerosol = std::exp(
        -std::pow(depth, 0.873) * (1.0 + depth - std::pow(depth, 0.7088)) * std::pow(mass, 0.9108));

    // Absorbed and scattered aerosol light: single scattering 0.9, forward share 0.84.
    const double absorbed = 1.0 - 0.1 * (1.0 - mass + std::pow(mass, 1.06)) * (1.0 - aerosol);
    const double back_scatter = 0.0685 + (1.0 - 0.84) * (1.0 - aerosol / absorbed);
    // (T23) of docs/theory.md
    const double direct = top * 0.9662 * rayleigh * ozone * mixed * water * aerosol;
    const double scattered = top * cosine * 0.79 * ozone * mixed * water * absorbed *
                             (0.5 * (1.0 - rayleigh) + 0.84 * (1.0 - aerosol / absorbed)) /
                             (1.0 - mass + std::pow(mass, 1.02));
    const double global = (direct * cosine + scattered) / (1.0 - sky.ground_albedo * back_scatter);
    return {direct, std::max(0.0, global - direct * cosine)};
}

Sunlight ineichen_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                            double elevation, double linke_turbidity) {
    if (sun_elevation_deg <= 0.0) return {0.0, 0.0};
    const double zenith_deg = 90.0 - sun_elevation_deg;
    const double cosine = std::sin(radians(sun_elevation_deg));
    const double top = solar_constant / (distance_au * distance_au);
    // Kasten & Young 1989, at the pressure of the place.
    const double mass =
        pressure / 101325.0 / (cosine + 0.50572 * std::pow(96.07995 - zenith_deg, -1.6364));
    const double low = std::exp(-elevation / 8000.0), high = std::exp(-elevation / 1250.0);
    const double haze = linke_turbidity - 1.0;
    const double global = (5.09e-5 * elevation + 0.868) * top * cosine *
                          std::exp(-(3.92e-5 * elevation + 0.0387) * mass * (low + high * haze));
    const double beam = top * (0.664 + 0.163 / low) * std::exp(-0.09 * mass * haze);
    const double most =
        global / cosine *
        std::max(0.0, 1.0 - (0.1 - 0.2 * std::exp(-linke_turbidity)) / (0.1 + 0.882 / low));
    const double direct = std::min(beam, most);
    return {direct, std::max(0.0, global - direct * cosine)};
}

LongwaveFormula formula_of_measured(const ClearSky& sky) {
    return sky.longwave == LongwaveFormula::none ? LongwaveFormula::dilley_obrien : sky.longwave;
}

ClearSky in_vacuum(ClearSky sky) {
    sky.bare_sun = true;
    sky.longwave = LongwaveFormula::none;
    return sky;
}

Sunlight clear_sunlight(const SunPosition& sun, const AirState& air, double elevation,
                        const ClearSky& clear) {
    if (clear.bare_sun) {
        if (!(sun.elevation_deg > 0.0)) return {0.0, 0.0};
        return {solar_constant / (sun.distance_au * sun.distance_au), 0.0};
    }
    const double pressure = air.pressure > 0.0 ? air.pressure : standard_pressure(elevation);
    if (!std::isnan(clear.linke_turbidity)) {
        return ineichen_clear_sky(sun.elevation_deg, sun.distance_au, pressure, elevation,
                                  clear.linke_turbidity);
    }
    const double water = std::isnan(clear.precipitable_water_cm) ? precipitable_water_cm(air)
                                                                 : clear.precipitable_water_cm;
    return bird_clear_sky(sun.elevation_deg, sun.distance_au, pressure, water, clear);
}

double clear_longwave(const AirState& air, LongwaveFormula formula) {
    const double t = air.temperature, e = air.vapour_pressure / 100.0;
    const double black = stefan_boltzmann * power4(t);
    switch (formula) {
        case LongwaveFormula::brutsaert:
            return 1.24 * std::pow(e / t, 1.0 / 7.0) * black;
        case LongwaveFormula::prata: {
            const double w = precipitable_water_cm(air);
            return (1.0 - (1.0 + w) * std::exp(-std::sqrt(1.2 + 3.0 * w))) * black;
        }
        case LongwaveFormula::brunt:
            return (0.52 + 0.065 * std::sqrt(e)) * black;
        case LongwaveFormula::idso:
            return (0.70 + 5.95e-5 * e * std::exp(1500.0 / t)) * black;
        case LongwaveFormula::swinbank:
            return 5.31e-13 * std::pow(t, 6);
        case LongwaveFormula::none:
            return 0.0;
        case LongwaveFormula::dilley_obrien:
            break;
    }
    return clear_longwave(air);
}

double clear_longwave(const AirState& air) {
    // (T24) of docs/theory.md
    const double t = air.temperature / 273.16;
    return 59.38 + 113.7 * std::pow(t, 6) + 96.96 * std::sqrt(precipitable_water_cm(air) / 2.5);
}

double cloudy_longwave(const AirState& air, double cloud_fraction, LongwaveFormula formula) {
    if (formula == LongwaveFormula::none) return 0.0;
    const double black = stefan_boltzmann * power4(air.temperature);
    // (T25) of docs/theory.md
    return cloud_fraction * black + (1.0 - cloud_fraction) * clear_longwave(air, formula);
}

}  // namespace diurna
