#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/units.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hills.hpp"
#include "thermal/solve/solver.hpp"

/// Hills of four materials under a summer day that repeats, with shadows and neighbours.
namespace hill_world {

using namespace diurna;

inline const Site tennessee{.latitude_deg = 36.5, .longitude_deg = -84.2, .height = 400.0};
inline const Instant june = parse_instant("2026-06-21T05:00:00Z");  // midnight there

inline Material ground(const char* name, double albedo, double emissivity, Convection convection,
                       std::vector<Layer> layers, Bottom bottom, Evaporation evaporation = {}) {
    Material material;
    material.name = name;
    material.thermal = {.albedo = albedo,
                        .solar_transmittance = 0.0,
                        .emissivity = emissivity,
                        .roughness_length = 0.02,
                        .heat_roughness_length = 0.002,
                        .convection = convection,
                        .evaporation = evaporation,
                        .internal_heat = 0.0,
                        .layers = std::move(layers),
                        .bottom = bottom,
                        .back = {}};
    return material;
}

/// Soil, wet grass, sheet steel over foam with a room below, glass.
inline MaterialLibrary mixed() {
    const Layer soil{3.0, 0.9, 1500.0, 1300.0};
    return MaterialLibrary({ground("soil", 0.2, 0.96, Louis{}, {soil}, FixedFlux{0.0}),
                            ground("grass", 0.22, 0.98, Louis{}, {{0.05, 0.4, 20.0, 3600.0}, soil},
                                   FixedFlux{0.0}, {.minimum_resistance = 70.0, .wetness = 1.0}),
                            ground("roof", 0.4, 0.9, Tarp{},
                                   {{0.0008, 45.0, 7800.0, 500.0}, {0.05, 0.03, 43.0, 1210.0}},
                                   Interior{.air_temperature = 293.15, .film = 7.7}),
                            ground("glass", 0.08, 0.84, Mowitt{}, {{0.006, 1.0, 2528.0, 880.0}},
                                   FixedTemperature{295.0})});
}

/// A summer day's weather, the same every day.
inline Weather summer() {
    Weather weather;
    for (int h = 0; h <= 24; ++h) {
        Forcing forcing;
        const double wave = std::cos(2.0 * M_PI * (h - 15) / 24.0);
        forcing.air.temperature = 297.0 + 6.0 * wave;
        forcing.air.vapour_pressure = 1500.0;
        forcing.air.pressure = 96000.0;
        forcing.wind_speed = 2.5 + 1.5 * wave;
        weather.instant.push_back(later(june, 3600.0 * h));
        weather.sample.push_back(forcing);
    }
    return weather;
}

struct World {
    FacetSet facets;
    RayScene rays;
    FacetViews view;
    MaterialLibrary materials = mixed();
    Weather weather = summer();

    explicit World(int n)
        : facets(hills(n, {MaterialId{0}, MaterialId{1}, MaterialId{2}, MaterialId{3}})),
          rays(facets),
          view(facet_views(facets, rays)) {}

    SolveResult run(const SolveOptions& options) const {
        const SunExposure sun = shadows(facets, rays, tennessee, options);
        return solve({.facets = facets,
                      .views = view,
                      .sun = sun,
                      .materials = materials,
                      .weather = weather,
                      .site = tennessee,
                      .elevation = 400.0},
                     options);
    }
};

inline double worst_difference(const TemperatureField& a, const TemperatureField& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.kelvin.size(); ++i) {
        worst = std::max(worst, std::abs(double(a.kelvin[i]) - b.kelvin[i]));
    }
    return worst;
}

}  // namespace hill_world
