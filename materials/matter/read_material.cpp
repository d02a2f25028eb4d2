#include "materials/matter/read_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/matter/read_layers.hpp"
#include "materials/matter/read_light.hpp"
#include "materials/matter/read_optics.hpp"

namespace diurna {

namespace {

/// [[hour, value], ...] with ascending hours of the clock; none where it is absent.
Schedule read_schedule(const Section& section, const char* key, const char* says, const char* value,
                       Range range) {
    Schedule schedule;
    if (!section.has(key)) return schedule;
    for (const std::vector<double>& entry : section.rows(key, says, 2)) {
        const bool ascends = schedule.empty() || entry[0] > schedule.back()[0];
        if (!(entry[0] >= 0.0 && entry[0] <= 24.0 && entry[1] >= range.least &&
              entry[1] <= range.most) ||
            !ascends) {
            section.mistake(key, fmt::format("expected [hour, {}] with ascending hours of 0 to 24 "
                                             "and values of {:g} to {:g}",
                                             value, range.least, range.most));
            break;
        }
        schedule.push_back({entry[0], entry[1]});
    }
    return schedule;
}

Bottom read_bottom(const Section& section) {
    const std::string kind =
        section.kind_or("a heat flux, a fixed temperature, or the air of a room", "flux",
                        {"flux", "temperature", "interior"});
    if (kind == "temperature") {
        return FixedTemperature{
            section.number("value_K", "boundary condition below the last layer", {1.0, 3000.0})};
    }
    if (kind == "interior") {
        Interior room{
            .air_temperature =
                section.number("air_temperature_K", "air temperature of the room", {150.0, 1500.0}),
            .film = section.number(
                "film_W_m2K", "coefficient between the last layer and the room's air", {0.0, 1e4})};
        room.schedule =
            read_schedule(section, "schedule",
                          "[[hour, K], ...] on the clock of time.start, instead of "
                          "air_temperature_K: interpolated linearly, also across midnight",
                          "temperature_K", {150.0, 1500.0});
        return room;
    }
    return FixedFlux{
        section.number_or("value_W_m2", "heat flux upward into the last layer", 0.0, {-1e5, 1e5})};
}

constexpr Range lengths{0.001, 1000.0};  // [m]

double read_wall_roughness(const Section& section, double usual) {
    return section.number_or("roughness",
                             "factor on the wind's share: 1 glass, 1.11 smooth plaster, 1.52 "
                             "concrete, 1.67 brick, 2.17 stucco",
                             usual, {1.0, 2.17});
}

Convection read_convection(const Section& section) {
    const std::string kind = section.kind_or(
        "model; louis: ground, by roughness and stability; plate, cylinder, box: parts of vehicles "
        "and devices, by size; tarp, mowitt: rough and smooth walls and roofs of buildings; "
        "constant: the coefficient value_W_m2K",
        "louis", {"louis", "plate", "cylinder", "box", "tarp", "mowitt", "constant"});
    if (kind == "constant") {
        return ConstantFilm{
            section.number("value_W_m2K", "the convective coefficient", {0.0, 1e4})};
    }
    if (kind == "tarp") {
        Tarp tarp;
        tarp.length = section.number_or(
            "length_m", "side of a square wall of the same ratio of perimeter to area", tarp.length,
            lengths);
        tarp.roughness = read_wall_roughness(section, tarp.roughness);
        return tarp;
    }
    if (kind == "mowitt") return Mowitt{read_wall_roughness(section, Mowitt{}.roughness)};
    if (kind != "louis") {
        BodyFilm body{kind == "plate"      ? BodyShape::plate
                      : kind == "cylinder" ? BodyShape::cylinder
                                           : BodyShape::box};
        body.length = section.number_or(
            "length_m", "side of a plate, width of a cylinder or box",
            {0.0, "the size of the part in a mesh; 1 on ground and in columns"}, lengths);
        if (kind == "plate") {
            body.transition =
                section.number_or("transition_Re",
                                  "Reynolds number of the transition to turbulence: 5e5 in a "
                                  "smooth flow, 1e5 in gusts, 0 if tripped at the edge",
                                  body.transition, {0.0, 3e6});
        }
        return body;
    }
    return Louis{
        .least_film =
            section.number_or("least_W_m2K", "minimum exchange in calm, stable air, which is added",
                              0.0, {0.0, 100.0}),
        .gust = section.number_or("gust_m_s", "air speed besides the mean wind U: √(U² + gust²)",
                                  1.0, {0.0, 20.0})};
}

Evaporation read_evaporation(const Section& section) {
    const std::string kind =
        section.kind_or("model; dry, or wet behind a resistance in series with the aerodynamic one",
                        "none", {"none", "resistance"});
    if (kind == "none") return {};
    return {.minimum_resistance =
                section.number("minimum_s_m", "resistance of the surface to vapour", {0.0, 1e5}),
            .wetness = section.number_or("wetness", "0 dry to 1 wet", 1.0, {0.0, 1.0})};
}

WaterStore read_store(const Section& section) {
    WaterStore store;
    store.capacity_mm = section.number(
        "capacity_mm",
        "water that level ground retains; the excess runs off, and slopes retain less (Kidd 1978)",
        {0.0, 1000.0});
    store.wet_albedo = section.number_or("wet_albedo", "albedo where wet",
                                         {-1.0, "that of the dry surface"}, {0.0, 1.0});
    store.leaves = section.flag_or("leaves", "facets of any slope retain as much", false);
    return store;
}

AgeingAlbedo read_snow_albedo(const Section& section) {
    AgeingAlbedo ageing;
    ageing.fresh = section.number_or("fresh", "albedo of new snow", ageing.fresh, {0.0, 1.0});
    ageing.old = section.number_or("old", "lowest albedo of aged snow; at most that of new snow",
                                   ageing.old, {0.0, ageing.fresh});
    return ageing;
}

Canopy read_canopy(const Section& section) {
    const std::string kind = section.kind_or(
        "model; none; big_leaf: one layer over the ground; two_source: leaves and the ground "
        "between them",
        "none", {"none", "big_leaf", "two_source"});
    if (kind == "big_leaf") {
        return BigLeaf{.skin_conductance = section.number(
                           "skin_conductance_W_m2K",
                           "heat transfer between leaves and ground surface", {0.01, 1e4})};
    }
    if (kind == "two_source") {
        return TwoSource{
            .leaf_area = section.number(
                "leaf_area", "leaf area index: m2 of leaves per m2 of ground", {0.0, 12.0}),
            .leaf_resistance =
                section.number("leaf_resistance_s_m",
                               "resistance of the whole canopy to transpiration", {0.0, 1e5})};
    }
    return std::monostate{};
}

std::optional<ExposedBack> read_back(const Section& section) {
    const std::string kind = section.kind_or(
        "exposed: a thin plate with air behind it, instead of a bottom; in an open mesh the back "
        "exchanges radiation with sky, sun and neighbours, in a closed one with surroundings at "
        "air temperature",
        "none", {"none", "exposed"});
    if (kind == "none") return std::nullopt;
    return ExposedBack{
        .emissivity = section.number("emissivity", "emissivity of the back", {0.0, 1.0}),
        .albedo = section.number("albedo", "albedo of the back", {0.0, 1.0})};
}

/// What a material starts from: the one it is like, or a dull black one where that is unknown.
struct Start {
    Material material;
    bool fresh = false;  // from nothing: it has to say everything
    bool lost = false;   // nobody can tell what the rest is
};

Start read_start(const Section& section, const MaterialLibrary& base, const std::string& name) {
    const std::vector<std::string> known = base.names();
    const auto is_known = [&](const std::string& word) {
        return std::find(known.begin(), known.end(), word) != known.end();
    };
    const std::string own_name = section.text_or(
        "name", "name of the material; in a column file: the library's material to start from",
        {name, "the name of the table"});
    const std::string like = section.text_or(
        "like",
        "starts from this material of the library or of the file; only the given keys change",
        {is_known(own_name) ? own_name : "", "the library's material of this name, if any"});
    Start start{.material = {}, .fresh = like.empty()};
    if (own_name.empty()) section.mistake("name", "missing, expected a text in quotes");
    if (is_known(like)) {
        start.material = base[base.find(like)];
    } else if (!start.fresh) {
        section.mistake(
            "like",
            "unknown material '" + like.substr(0, 60) + "', which must come earlier in this file",
            did_you_mean(like, known));
        start.material.reflectance = two_step_reflectance(0.0, 1.0);
    } else if (section.has("name") && !section.has("layers")) {
        section.mistake("name", "unknown material '" + own_name.substr(0, 60) + "' in the library",
                        did_you_mean(own_name, known));
        start.material.reflectance = two_step_reflectance(0.0, 1.0);
        start.lost = true;
        return start;
    }
    start.material.name = own_name;
    return start;
}

/// What happens at the surface besides convection: water, leaves, heat of its own.
void read_surface(const Section& section, ThermalSurface& thermal) {
    if (section.has("evaporation")) {
        thermal.evaporation = read_evaporation(
            section.section("evaporation", "evaporation of water from the surface"));
    }
    if (section.has("store")) {
        thermal.store = read_store(
            section.section("store",
                            "water on the surface: rain and dew fill the store, it freezes and "
                            "melts, and snow lies on it; capacity_mm = 0: none"));
    }
    if (section.has("snow_albedo")) {
        thermal.snow_albedo = read_snow_albedo(
            section.section("snow_albedo",
                            "ageing of snow's albedo with days and melting, from the given one "
                            "(Douville et al. 1995); new snow restores it"));
    }
    if (section.has("canopy")) {
        thermal.canopy = read_canopy(section.section("canopy", "leaves above the ground"));
    }
    thermal.internal_heat = section.number_or(
        "internal_heat_W_m2", "heat released at the surface: engines, people, lamps",
        {thermal.internal_heat, "0"}, {-1e5, 1e6});
    if (section.has("internal_schedule")) {
        thermal.internal_schedule =
            read_schedule(section, "internal_schedule",
                          "[[hour, W/m2], ...] on the clock of time.start, instead of "
                          "internal_heat_W_m2: interpolated linearly, also across midnight",
                          "heat_W_m2", {-1e5, 1e6});
    }
}

/// Behind a sheet whose back is open lies nothing: no room either that it was `like`.
void close_bottom(const Section& section, ThermalSurface& thermal) {
    const auto* flux = std::get_if<FixedFlux>(&thermal.bottom);
    const bool empty = flux && flux->flux == 0.0;
    if (section.has("bottom") && !empty) {
        section.mistake("bottom", "a sheet with an open back has nothing below its last layer",
                        "remove `bottom` or `back`");
    }
    thermal.bottom = FixedFlux{0.0};
}

}  // namespace

Material read_material(const Section& section, const MaterialLibrary& base,
                       const std::string& name) {
    Start start = read_start(section, base, name);
    Material& material = start.material;
    if (start.lost) return material;
    read_light(section, start.fresh, material);
    ThermalSurface& thermal = material.thermal;
    if (start.fresh || section.has("roughness_length_m")) {
        thermal.roughness_length =
            section.number("roughness_length_m",
                           "roughness length for momentum; required without `like`", {1e-6, 10.0});
        thermal.heat_roughness_length = thermal.roughness_length / 10.0;
    }
    thermal.heat_roughness_length = section.number_or(
        "heat_roughness_length_m", "roughness length for heat",
        {thermal.heat_roughness_length, "a tenth of the one for momentum"}, {1e-12, 10.0});
    read_layers(section, start.fresh, thermal);
    if (section.has("bottom")) {
        thermal.bottom = read_bottom(section.section("bottom", "boundary below the last layer"));
    }
    if (section.has("convection")) {
        thermal.convection =
            read_convection(section.section("convection", "heat exchange between surface and air"));
    }
    read_surface(section, thermal);
    if (section.has("back")) {
        thermal.back = read_back(
            section.section("back",
                            "the open back of a thin plate. An open mesh "
                            "(docs/reference/targets.md#open-meshes) always "
                            "has one; without this key it has the properties of the front"));
        if (thermal.back) close_bottom(section, thermal);
    }
    return material;
}

}  // namespace diurna
