#include "scenes/job/world/air_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna {

namespace {

constexpr double mass_step = 0.35;           // of mass_coordinate
constexpr double vapour_of_sun_step = 0.7;   // of that of vapour pressure
constexpr double vapour_of_heat_step = 0.3;  // likewise
constexpr double warmth_step = 4.0;          // [K]
constexpr double least_elevation_deg = 0.3;
constexpr double least_vapour = 5.0;  // [Pa]
constexpr double darkest = -60.0;     // logarithm of a ratio

double ln_vapour(const AirState& air) {
    return std::log(std::max(least_vapour, air.vapour_pressure));
}

/// Kasten & Young 1989.
double air_mass(double elevation_deg) {
    return 1.0 / (std::sin(radians(elevation_deg)) +
                  0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

/// Of an air mass: nodes crowd where the sun is low.
double mass_coordinate(double elevation_deg) {
    const double mass = std::max(1.0, air_mass(elevation_deg));
    return std::log(mass) + 0.05 * (mass - 1.0);
}

double elevation_at(double coordinate) {
    double low = 0.0, high = 90.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (mass_coordinate(middle) > coordinate ? low : high) = middle;
    }
    return std::max(least_elevation_deg, 0.5 * (low + high));
}

/// A place between two nodes of an axis.
struct Place {
    int low;
    double share;
};
Place place_on(double value, double step) {
    const double at = value / step;
    const double low = std::floor(at);
    return {int(low), at - low};
}

Place mass_place(const SunPosition& sun) {
    return place_on(mass_coordinate(std::max(least_elevation_deg, sun.elevation_deg)), mass_step);
}

Sunlight formula_sun(const AirState& air, double elevation_deg, double distance_au) {
    return bird_clear_sky(std::max(least_elevation_deg, elevation_deg), distance_au, air.pressure,
                          precipitable_water_cm(air));
}

/// Calls body(key, share) for the four corners of a cell.
template <class Body>
void each_corner(const Place& a, const Place& b, const Body& body) {
    for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
            body(std::pair(a.low + i, b.low + j),
                 (i ? a.share : 1.0 - a.share) * (j ? b.share : 1.0 - b.share));
        }
    }
}

/// Mean air of the moments about a vapour pressure: how warm it is there when it is so moist.
AirState usual_air(std::span<const AirMoment> moments, double ln_of_vapour) {
    double weights = 0.0, warmth = 0.0, pressure = 0.0;
    for (const AirMoment& moment : moments) {
        const double away = (ln_vapour(moment.air) - ln_of_vapour) / vapour_of_sun_step;
        const double weight = std::exp(-2.0 * away * away);
        weights += weight;
        warmth += weight * moment.air.temperature;
        pressure += weight * moment.air.pressure;
    }
    AirState air{warmth / weights, pressure / weights, std::exp(ln_of_vapour)};
    while (saturation_vapour_pressure(air.temperature) < 1.03 * air.vapour_pressure) {
        air.temperature += 0.5;
    }
    return air;
}

template <class Of>
void fill(std::map<std::pair<int, int>, std::array<double, 2>>& table, const Of& of) {
    std::vector<std::pair<int, int>> keys;
    for (const auto& [key, none] : table) keys.push_back(key);
    std::vector<std::array<double, 2>> found(keys.size());
    for_each_index(
        keys.size(), [&](std::size_t k) { found[k] = of(keys[k]); }, 1);
    for (std::size_t k = 0; k < keys.size(); ++k) table[keys[k]] = found[k];
}

double ln_ratio(double of, double to) {
    return of > 0.0 && to > 0.0 ? std::max(darkest, std::log(of / to)) : darkest;
}

}  // namespace

AirLight::AirLight(const std::function<BandModel(const AirState&)>& air_of, double ground_km,
                   std::span<const AirMoment> moments, const Wanted& wanted) {
    for (const AirMoment& moment : moments) {
        const double vapour = ln_vapour(moment.air);
        if (wanted.longwave) {
            each_corner(place_on(moment.air.temperature, warmth_step),
                        place_on(vapour, vapour_of_heat_step),
                        [&](Key key, double) { longwave_[key] = {}; });
        }
        if (!wanted.sunlight || moment.sun.elevation_deg <= 0.0) continue;
        each_corner(mass_place(moment.sun), place_on(vapour, vapour_of_sun_step),
                    [&](Key key, double) { sunlight_[key] = {}; });
    }
    fill(sunlight_, [&](Key key) -> Ratios {
        const AirState air = usual_air(moments, key.second * vapour_of_sun_step);
        const double elevation = elevation_at(key.first * mass_step);
        const GroundFluxes flux =
            ground_sunlight(air_of(air), {.zenith_deg = 90.0 - elevation}, ground_km);
        const Sunlight formula = formula_sun(air, elevation, 1.0);
        return {ln_ratio(flux.sun_direct, formula.direct_normal),
                ln_ratio(flux.sun_diffuse, formula.diffuse_horizontal)};
    });
    fill(longwave_, [&](Key key) -> Ratios {
        AirState air = usual_air(moments, key.second * vapour_of_heat_step);
        air.temperature = key.first * warmth_step;
        air.vapour_pressure = std::min(std::exp(key.second * vapour_of_heat_step),
                                       0.99 * saturation_vapour_pressure(air.temperature));
        BandModel model = air_of(air);
        const double clear = ground_longwave(model, ground_km);
        model.cloud.fraction = 1.0;
        return {clear / clear_longwave(air),
                wanted.overcast ? ground_longwave(model, ground_km) /
                                      (stefan_boltzmann * std::pow(air.temperature, 4))
                                : 1.0};
    });
}

CloudlessLight AirLight::at(const AirMoment& moment) const {
    CloudlessLight light;
    const double vapour = ln_vapour(moment.air);
    if (!sunlight_.empty() && moment.sun.elevation_deg > 0.0) {
        Ratios sum{};
        each_corner(mass_place(moment.sun), place_on(vapour, vapour_of_sun_step),
                    [&](Key key, double share) {
                        const Ratios& at = sunlight_.at(key);
                        for (std::size_t i = 0; i < at.size(); ++i) sum[i] += share * at[i];
                    });
        const Sunlight formula =
            formula_sun(moment.air, moment.sun.elevation_deg, moment.sun.distance_au);
        light.direct_normal = formula.direct_normal * std::exp(sum[0]);
        light.diffuse = formula.diffuse_horizontal * std::exp(sum[1]);
    }
    if (!longwave_.empty()) {
        Ratios sum{};
        each_corner(place_on(moment.air.temperature, warmth_step),
                    place_on(vapour, vapour_of_heat_step), [&](Key key, double share) {
                        const Ratios& at = longwave_.at(key);
                        for (std::size_t i = 0; i < at.size(); ++i) sum[i] += share * at[i];
                    });
        light.longwave = sum[0] * clear_longwave(moment.air);
        light.longwave_overcast = sum[1] * stefan_boltzmann * std::pow(moment.air.temperature, 4);
    }
    return light;
}

}  // namespace diurna
