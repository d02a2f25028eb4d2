#include "scenes/job/plan/decisions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/atmosphere/band_model.hpp"
#include "materials/radiation/band.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/world/light_source.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

namespace {

/// "" where only facets that pictures need are solved.
std::string why_every_facet(const Scene& scene, const World& world,
                            std::span<const Sequence> sequences) {
    // Scenes of this size are solved in a second or two, and the result serves any pictures. A
    // tolerance in the file applies to smaller ones, too.
    const std::size_t few_facets = scene.tolerance_given ? 5000 : 20000;
    if (scene.exact) return "exact is true";
    if (!(scene.tolerance > 0.0)) return "tolerance_K is 0";
    if (scene.output.state) return "the state of all facets is saved (output.state)";
    if (scene.time.spin_up == SpanStart::state)
        return "the solution continues from a state of all facets";
    if (!scene.radiometers.empty()) return "radiometers see the whole scene";
    if (sequences.empty()) return "there are no pictures";
    if (world.surfaces().size() <= few_facets) {
        return fmt::format("the scene has at most {} facets", few_facets);
    }
    return "";
}

void sort_by_water(const Scene& scene, const World& world, Decisions& decisions) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const MaterialId id : world.surfaces().material) used[index(id)] = true;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const Material& material = scene.materials[MaterialId{static_cast<std::uint16_t>(i)}];
        const ThermalSurface& surface = material.thermal;
        const bool holds = surface.store.capacity_mm > 0.0 || surface.snow_albedo;
        std::vector<std::string>& kinds = surface.evaporation.wetness > 0.0 ? decisions.evaporating
                                          : holds ? decisions.holding_water
                                                  : decisions.dry;
        if (std::find(kinds.begin(), kinds.end(), material.kind()) == kinds.end()) {
            kinds.push_back(material.kind());
        }
    }
    // A sheet's inner side has a material of the same name, without a store.
    std::erase_if(decisions.dry, [&](const std::string& kind) {
        return std::find(decisions.holding_water.begin(), decisions.holding_water.end(), kind) !=
               decisions.holding_water.end();
    });
}

std::vector<Band> bands_of(const Scene& scene, const ObserverInput& observer) {
    std::vector<Band> bands;
    for (const std::string& name : observer.bands) {
        bands.push_back(named_band(scene.bands, name, bin_edges_um()));
    }
    for (const CubeInput& cube : scene.cubes) {
        const bool own = std::find(observer.cubes.begin(), observer.cubes.end(), cube.name) !=
                         observer.cubes.end();
        if (own) bands.push_back(flat_band(cube.name, cube.from_um, cube.to_um));
    }
    return bands;
}

PictureLight light_of_pictures(const Scene& scene, const World& world, const Weather& weather) {
    PictureLight light;
    if (weather.instant.empty()) return light;
    for (const ObserverInput& observer : scene.observers) {
        const std::vector<Band> bands = bands_of(scene, observer);
        for (const Instant when : observer.frames) {
            const SunPosition sun = apparent_sun(world.site, world.sea_level_height, weather, when);
            const LightSource source = light_source(sun, world.site, when, bands);
            ++(source.moon                        ? light.moon
               : source.place.elevation_deg > 0.0 ? light.sun
                                                  : light.neither);
        }
    }
    return light;
}

}  // namespace

Decisions decisions_of(const Scene& scene, const World& world, const Weather& weather,
                       std::span<const Sequence> sequences) {
    const std::string every_facet = why_every_facet(scene, world, sequences);
    // As can_check() (scenes/job/run/heat.hpp).
    const bool can_check = !scene.output.state && scene.time.spin_up != SpanStart::state;
    Decisions decisions{.heat = {.every_facet = every_facet,
                                 .tolerance = every_facet.empty() ? scene.tolerance : 0.0,
                                 .check_points = can_check ? scene.check_points : 0}};
    sort_by_water(scene, world, decisions);
    decisions.light = light_of_pictures(scene, world, weather);
    decisions.views_cast_once = static_cast<std::size_t>(std::count_if(
        sequences.begin(), sequences.end(), [](const Sequence& one) { return !one.goes; }));
    decisions.terms = std::any_of(scene.observers.begin(), scene.observers.end(),
                                  [](const ObserverInput& observer) { return observer.terms; });
    decisions.uncertain = scene.uncertain.size();
    decisions.rounds = decisions.heat.check_points > 0 && scene.tolerance > 0.0 ? scene.rounds : 0;
    return decisions;
}

}  // namespace diurna
