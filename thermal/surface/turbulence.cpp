#include "thermal/surface/turbulence.hpp"

#include <array>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

// Businger and Dyer's integrated stability functions for z/L < 0.
double psi_momentum(double z_over_l) {
    const double x = std::sqrt(std::sqrt(1.0 - 16.0 * z_over_l));
    return 2.0 * std::log((1.0 + x) / 2.0) + std::log((1.0 + x * x) / 2.0) - 2.0 * std::atan(x) +
           std::numbers::pi / 2.0;
}

double psi_heat(double z_over_l) {
    return 2.0 * std::log((1.0 + std::sqrt(1.0 - 16.0 * z_over_l)) / 2.0);
}

struct Sample {
    double x, f;
};

/// The transfer function along z/L: no iteration, because L is the parameter and x follows from it.
std::array<Sample, 60> transfer_function(double log_momentum, double log_heat, double wind_height,
                                         double air_height) {
    const double momentum_ratio = std::exp(-log_momentum), heat_ratio = std::exp(-log_heat);
    std::array<Sample, 60> samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double z = -std::pow(10.0, -3.0 + 4.0 * double(i) / 59.0);  // wind height over L
        const double r = z * air_height / wind_height;
        const double m = log_momentum - psi_momentum(z) + psi_momentum(z * momentum_ratio);
        const double h = log_heat - psi_heat(r) + psi_heat(r * heat_ratio);
        samples[i] = {-z * h / (m * m), log_momentum * log_heat / (m * h)};
    }
    return samples;
}

}  // namespace

LouisForm louis_form(double roughness_length, double heat_roughness_length, double wind_height,
                     double air_height) {
    wind_height = std::max(wind_height, 2.0 * roughness_length);
    air_height = std::max(air_height, 2.0 * heat_roughness_length);
    LouisForm form{.log_momentum = std::log(wind_height / roughness_length),
                   .log_heat = std::log(air_height / heat_roughness_length),
                   .wind_height = wind_height,
                   .a = 0.0,
                   .c = 0.0,
                   .s = 0.0,
                   .worst_fit = 1e9};
    const double ratio = form.log_momentum / form.log_heat;
    form.s = 5.0 * ratio * (1.0 + air_height / wind_height * ratio);

    // For a given c the best a is linear; c is searched over the decades it can lie in.
    const auto samples =
        transfer_function(form.log_momentum, form.log_heat, wind_height, air_height);
    for (double c = 0.1; c < 100.0; c *= 1.02) {
        double weight = 0.0, sum = 0.0;
        for (const auto& [x, f] : samples) {
            const double basis = x / (1.0 + c * std::sqrt(x)) / f;
            weight += basis * basis;
            sum += basis * (f - 1.0) / f;
        }
        const double a = sum / weight;
        double worst = 0.0;
        for (const auto& [x, f] : samples) {
            worst = std::max(worst, std::abs((1.0 + a * x / (1.0 + c * std::sqrt(x))) / f - 1.0));
        }
        if (worst < form.worst_fit) {
            form.a = a;
            form.c = c;
            form.worst_fit = worst;
        }
    }
    return form;
}

AirFilm air_film(const ThermalSurface& surface, const LouisForm& louis, const AirState& given,
                 double wind_speed) {
    AirState air = given, reference = given;
    double wind = std::max(wind_speed, least_wind);
    if (surface.flight) {
        wind = surface.flight->speed;
        const auto* body = std::get_if<BodyFilm>(&surface.convection);
        const double recovery =
            recovery_factor(given, *surface.flight, (body ? *body : BodyFilm{}).transition);
        air.temperature = recovery_temperature(given.temperature, wind, recovery);
        // Eckert 1955: T + 0.5 (T_s − T) + 0.22 (T_r − T), at T_s = T_r.
        reference.temperature += 0.72 * (air.temperature - given.temperature);
    }
    const double capacity = air_density(air) * dry_air_heat_capacity;
    AirFilm film{};
    film.air_temperature = air.temperature;
    film.heat_capacity = capacity;
    film.vapour_pressure = air.vapour_pressure;
    film.latent =
        air_density(air) * latent_heat_of_vaporisation(air.temperature) * 0.62198 / air.pressure;
    film.resistance = surface.evaporation.minimum_resistance;
    film.wetness = surface.evaporation.wetness;
    if (const auto* constant = std::get_if<ConstantFilm>(&surface.convection)) {
        film.neutral = constant->film;
    } else if (const auto* tarp = std::get_if<Tarp>(&surface.convection)) {
        film.kind = FilmKind::wall;
        film.plate = plate_air(*tarp, reference, wind);
    } else if (const auto* mowitt = std::get_if<Mowitt>(&surface.convection)) {
        film.kind = FilmKind::wall;
        film.plate = plate_air(*mowitt, reference, wind);
    } else if (const auto* body = std::get_if<BodyFilm>(&surface.convection)) {
        film.kind = FilmKind::body;
        film.plate = plate_air(*body, reference, wind);
    } else {
        const Louis& ground = std::get<Louis>(surface.convection);
        // (T2) of docs/theory.md
        const double mixing = std::hypot(wind, ground.gust);
        film.neutral =
            capacity * von_karman * von_karman * mixing / (louis.log_momentum * louis.log_heat);
        film.instability = gravity * louis.wind_height / (air.temperature * mixing * mixing);
        film.least = ground.least_film;
        film.a = louis.a;
        film.c = louis.c;
        film.s = louis.s;
    }
    return film;
}

}  // namespace diurna
