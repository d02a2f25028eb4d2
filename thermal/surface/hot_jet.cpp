#include "thermal/surface/hot_jet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/air/moist_air.hpp"
#include "materials/air/transport.hpp"

namespace diurna {

namespace {

constexpr double speed_decay = 6.2, warmth_decay = 5.0;
constexpr double speed_spread = 0.107, warmth_spread = 0.127;
constexpr double wall_way = 3.0;                       // of r, as so much of the way along the axis
constexpr double least_warmth = 0.05;                  // fading from twice that
constexpr double core = 2.5, fading = 15.0, end = 20;  // [diameters] from the stagnation point
constexpr double nearest_plate = 2.0, furthest_plate = 12.0;  // [diameters] of Martin's outlets
constexpr double gas_heat_capacity = 1050.0;  // [J kg⁻¹ K⁻¹] air at 500 K: 1030, 800: 1099

double density(double pressure, double kelvin) {
    return pressure / (dry_air_gas_constant * kelvin);
}
/// D* [m]
double momentum_diameter(const HotJet& jet) {
    return jet.diameter * std::sqrt(jet.air_temperature / jet.temperature);
}
double bell(double off, double width) { return std::exp(-off * off / (width * width)); }

/// Of the mean of gas and air.
struct HotGas {
    double conductivity, kinematic, prandtl;
};
HotGas mean_gas(const HotJet& jet) {
    const double kelvin = 0.5 * (jet.temperature + jet.air_temperature);
    const double viscosity = air_viscosity(kelvin), conductivity = air_conductivity(kelvin);
    return {conductivity, viscosity / density(jet.pressure, kelvin),
            dry_air_heat_capacity * viscosity / conductivity};
}

/// Martin's G of the ring at r = ρ diameters, and of the circle within.
double ring(double rho, double k) {
    return (rho * rho + 2.0 * k * rho - 1.1 * k) / (2.0 * rho * (rho + k) * (rho + k));
}
double circle(double rho, double k) { return (rho - 1.1) / (rho * (rho + k)); }

double martin(double rho, double k) {
    if (rho < core) {
        const double edge = ring(core, k), mean = circle(core, k), s = rho / core;
        return edge + 2.0 * (mean - edge) * (1.0 - s * s);
    }
    return ring(rho, k) * std::clamp((end - rho) / (end - fading), 0.0, 1.0);
}

/// Of what the jet brings, sent in a direction: as the square of a diameter.
double sent_towards(double sine, double cosine, double downstream) {
    constexpr double most = 4.0;
    const double less = 1.0 - cosine * downstream;
    return std::min(most, sine * sine * sine / std::max(1e-9, less * less));
}

JetFilm head_on(const HotJet& jet, const HotGas& gas, const Eigen::Vector3d& direction,
                const Eigen::Vector3d& place, const Eigen::Vector3d& normal, bool met) {
    const double sine = -direction.dot(normal);
    if (!(sine > 1e-3)) return {};
    const double height = place.dot(normal) / direction.dot(normal);
    if (!(height > 0.0)) return {};  // the plane lies behind the outlet
    const Eigen::Vector3d from = place - height * direction;
    const double r = from.norm();
    const double diameter = std::max(jet.diameter, height / furthest_plate);
    double spread = 1.0;
    if (r > 0.0) {
        const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
        const Eigen::Vector3d plane = direction + sine * normal;  // of length `cosine`
        const double downstream = cosine > 1e-9 ? from.dot(plane) / (r * cosine) : 0.0;
        spread = std::pow(sent_towards(sine, cosine, downstream),
                          0.5 * std::min(1.0, r / (core * diameter)));
    }
    if (!(spread > 1e-6)) return {};
    const double k = 0.1 * (std::clamp(height / diameter, nearest_plate, furthest_plate) - 6.0);
    const double reynolds = jet.speed * jet.diameter / gas.kinematic;
    const double of_reynolds = 2.0 * std::sqrt(reynolds * (1.0 + 0.005 * std::pow(reynolds, 0.55)));
    const double away = r / spread;
    JetFilm wall{.film = martin(away / diameter, k) * std::pow(gas.prandtl, 0.42) * of_reynolds *
                         gas.conductivity / diameter,
                 .warmth = std::min(
                     1.0, warmth_decay * momentum_diameter(jet) / (height + wall_way * away))};
    if (met) return wall;
    const double along = place.dot(direction), off = (place - along * direction).norm();
    const FreeJet here = free_jet(jet, along, off), axis = free_jet(jet, along, 0.0);
    if (!(axis.speed > 0.0)) return {};
    wall.film *= here.speed / axis.speed;
    wall.warmth = here.warmth;
    return wall;
}

JetFilm along_it(const HotJet& jet, const HotGas& gas, const Eigen::Vector3d& direction,
                 const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
    constexpr double turned_away = 0.1;
    if (direction.dot(normal) > turned_away) return {};
    const double along = place.dot(direction);
    const double off = (place - along * direction).norm();
    const FreeJet here = free_jet(jet, along, off);
    if (!(here.speed > 0.0)) return {};
    const double x = std::max(along, jet.diameter);
    const double reynolds = here.speed * jet.speed * x / gas.kinematic;
    return {0.0296 * std::pow(reynolds, 0.8) * std::cbrt(gas.prandtl) * gas.conductivity / x,
            here.warmth};
}

}  // namespace

double mass_flow(const HotJet& jet) {
    return density(jet.pressure, jet.temperature) * jet.speed * 0.25 * std::numbers::pi *
           jet.diameter * jet.diameter;
}
double heat_flow(const HotJet& jet) { return gas_heat_capacity * mass_flow(jet); }
double speed_of(double flow, const HotJet& jet) {
    return flow / (density(jet.pressure, jet.temperature) * 0.25 * std::numbers::pi * jet.diameter *
                   jet.diameter);
}

FreeJet free_jet(const HotJet& jet, double along, double off) {
    if (!(along > 0.0)) return {0.0, 0.0};
    const double decay = momentum_diameter(jet) / along, least = 0.5 * jet.diameter;
    return {
        std::min(1.0, speed_decay * decay) * bell(off, std::max(least, speed_spread * along)),
        std::min(1.0, warmth_decay * decay) * bell(off, std::max(least, warmth_spread * along))};
}

JetFilm jet_film(const HotJet& jet, const Eigen::Vector3d& direction, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& normal, bool met) {
    const HotGas gas = mean_gas(jet);
    const JetFilm wall = head_on(jet, gas, direction, place, normal, met),
                  beside = along_it(jet, gas, direction, place, normal);
    JetFilm film = wall.film * wall.warmth > beside.film * beside.warmth ? wall : beside;
    film.film *= std::clamp(film.warmth / least_warmth - 1.0, 0.0, 1.0);
    return film.film > 0.0 ? film : JetFilm{};
}

double jet_reach(const HotJet& jet) {
    // Along the axis, and from where it ends at a wall.
    return warmth_decay * momentum_diameter(jet) / least_warmth * 1.2;
}

}  // namespace diurna
