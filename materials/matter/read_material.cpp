#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_finish.hpp"
#include "materials/matter/soil.hpp"

namespace diurna {

namespace {

constexpr double shortest_um = 0.2, longest_um = 100.0;
constexpr double split_um = 4.0;  // sunlight below, own emission above

/// Keeps its end values out to 0.2 and 100 µm, so that no band looks past a spectrum's end.
Spectrum extended(Spectrum s) {
    if (s.wavelength_um.front() > shortest_um) {
        s.wavelength_um.insert(s.wavelength_um.begin(), shortest_um);
        s.value.insert(s.value.begin(), s.value.front());
    }
    if (s.wavelength_um.back() < longest_um) {
        s.wavelength_um.push_back(longest_um);
        s.value.push_back(s.value.back());
    }
    return s;
}

Spectrum flat(double albedo, double emissivity) {
    return {.wavelength_um = {shortest_um, split_um, split_um + 1e-4, longest_um},
            .value = {albedo, albedo, 1.0 - emissivity, 1.0 - emissivity}};
}

/// The spectrum with separate factors below and above 4 µm, cut into two there.
Spectrum scaled(const Spectrum& s, double below, double above) {
    Spectrum result;
    const auto append = [&](double wavelength, double value) {
        result.wavelength_um.push_back(wavelength);
        result.value.push_back(std::clamp(value, 0.0, 1.0));
    };
    for (std::size_t i = 0; i < s.value.size(); ++i) {
        const double wavelength = s.wavelength_um[i];
        const bool crosses = i > 0 && s.wavelength_um[i - 1] <= split_um && wavelength > split_um;
        if (crosses) {
            if (s.wavelength_um[i - 1] < split_um) append(split_um, below * s.at(split_um));
            append(split_um + 1e-4, above * s.at(split_um + 1e-4));
        }
        if (crosses && wavelength <= split_um + 1e-4) continue;
        append(wavelength, (wavelength <= split_um ? below : above) * s.value[i]);
    }
    return result;
}

/// 1 − ρ − τ on the union of both grids.
Spectrum absorptance(const Spectrum& reflectance, const Spectrum& transmittance) {
    std::vector<double> grid = reflectance.wavelength_um;
    grid.insert(grid.end(), transmittance.wavelength_um.begin(), transmittance.wavelength_um.end());
    std::sort(grid.begin(), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    Spectrum result{.wavelength_um = grid, .value = {}};
    for (const double um : grid) {
        result.value.push_back(1.0 - reflectance.at(um) - transmittance.at(um));
    }
    return result;
}

Spectrum read_file(const Section& section, const char* key, const std::filesystem::path& folder) {
    const std::string name = section.text(key);
    try {
        return extended(read_spectrum(folder / name, 0.0, 1.0));
    } catch (const InputError& error) {
        section.mistake(key, error.what());
        return flat(0.0, 1.0);
    }
}

/// Spectra from files, from `albedo` and `emissivity` alone, or both: then the files give the shape
/// and the numbers the means.
void read_optics(const Section& section, const std::filesystem::path& folder, bool fresh,
                 Material& material) {
    ThermalSurface& thermal = material.thermal;
    // Without a file a material of its own needs both numbers; otherwise each may change a mean.
    const bool needed = fresh && !section.has("reflectance");
    const bool has_albedo = section.has("albedo"), has_emissivity = section.has("emissivity");
    const double given_albedo = needed || has_albedo ? section.number("albedo", 0.0, 1.0) : 0.0;
    const double given_emissivity =
        needed || has_emissivity ? section.number("emissivity", 0.0, 1.0) : 1.0;
    if (section.has("reflectance")) {
        material.reflectance = read_file(section, "reflectance", folder);
    } else if (fresh) {
        material.reflectance = flat(given_albedo, given_emissivity);
    }
    if (section.has("transmittance")) {
        material.transmittance = read_file(section, "transmittance", folder);
    }
    Spectrum absorbed = absorptance(material.reflectance, material.transmittance);
    const auto least = std::min_element(absorbed.value.begin(), absorbed.value.end());
    if (*least < -1e-9) {
        const double um =
            absorbed.wavelength_um[static_cast<std::size_t>(least - absorbed.value.begin())];
        section.mistake("reflectance",
                        fmt::format("reflectance and transmittance add up to {:.4g} at {:g} µm, "
                                    "expected at most 1",
                                    1.0 - *least, um));
    }
    thermal.solar_transmittance = solar_mean(material.transmittance);
    thermal.albedo = solar_mean(material.reflectance);
    thermal.emissivity = planck_mean(absorbed);
    if (needed) {  // the means of a flat spectrum differ from these by the tail beyond 4 µm
        thermal.albedo = given_albedo;
        thermal.emissivity = given_emissivity;
        return;
    }
    if (!has_albedo && !has_emissivity) return;

    const double albedo = has_albedo ? given_albedo : thermal.albedo;
    const double emissivity = has_emissivity ? given_emissivity : thermal.emissivity;
    if (albedo + thermal.solar_transmittance > 1.0) {
        section.mistake("albedo", fmt::format("found {:g}, expected at most {:.4g}: the rest of "
                                              "the sun passes through",
                                              albedo, 1.0 - thermal.solar_transmittance));
    }
    const double reflected = planck_mean(material.reflectance);
    const double wanted = std::max(0.0, reflected + thermal.emissivity - emissivity);
    const double below = thermal.albedo > 0.0 ? albedo / thermal.albedo : 1.0;
    const double above = reflected > 0.0 ? wanted / reflected : 1.0;
    Spectrum fitted = scaled(material.reflectance, below, above);
    // A spectrum that cannot be scaled to these means (dark, or cut off at 1) is made flat.
    if (std::abs(solar_mean(fitted) - albedo) > 0.01 ||
        std::abs(planck_mean(fitted) - wanted) > 0.01) {
        fitted = flat(albedo, 1.0 - wanted);
    }
    material.reflectance = std::move(fitted);
    thermal.albedo = albedo;
    thermal.emissivity = emissivity;
}

/// { thickness_m, soil = "loam", saturation, ... }
Layer read_soil(const Section& layer) {
    const std::string name = layer.word_or("soil", "loam", soil_names());
    Soil soil = soil_named(name);
    soil.saturation = layer.number("saturation", 0.0, 1.0);
    soil.porosity = layer.number_or("porosity", soil.porosity, 0.0, 0.95);
    soil.grain_conductivity =
        layer.number_or("grain_conductivity_W_mK", soil.grain_conductivity, 0.05, 10.0);
    soil.grain_density = layer.number_or("grain_density_kg_m3", soil.grain_density, 100.0, 8000.0);
    soil.grain_heat_capacity =
        layer.number_or("grain_heat_capacity_J_kgK", soil.grain_heat_capacity, 100.0, 5000.0);
    Layer result = soil_layer(soil, layer.number("thickness_m", 1e-5, 100.0));
    if (!layer.flag_or("freezes", true)) result.law = Constant{};
    return result;
}

/// What a layer of given constants does beyond them.
ThermalLaw read_law(const Section& layer) {
    if (layer.has("freezing_water_kg_m3")) {
        return Freezing{
            .water = layer.number("freezing_water_kg_m3", 0.0, 1000.0),
            .frozen_conductivity = layer.number("frozen_conductivity_W_mK", 0.005, 500.0),
            .frozen_heat_capacity = layer.number("frozen_heat_capacity_J_kgK", 50.0, 2e4)};
    }
    if (layer.has("melts") && layer.flag_or("melts", false)) {
        return Melting{.held = layer.number_or("held_water", 0.05, 0.0, 1.0)};
    }
    if (layer.has("cubic_K3")) {
        Radiating law{.cubic = layer.number("cubic_K3", 0.0, 1e-3), .heat = {}};
        const std::vector<double> heat = layer.numbers("heat_capacity_polynomial", 5);
        if (heat.size() == 5) std::copy(heat.begin(), heat.end(), law.heat.begin());
        return law;
    }
    return Constant{};
}

void read_layers(const Section& section, bool fresh, ThermalSurface& thermal) {
    if (!section.has("layers")) {
        if (fresh) {
            section.mistake("layers",
                            "missing, expected an array of { thickness_m, conductivity_W_mK, "
                            "density_kg_m3, heat_capacity_J_kgK }, the surface first");
        }
        return;
    }
    thermal.layers.clear();
    for (const Section& layer : section.sections("layers")) {
        if (layer.has("soil")) {
            thermal.layers.push_back(read_soil(layer));
            continue;
        }
        if (layer.has("regolith") && layer.flag_or("regolith", false)) {
            for (const Layer& part : lunar_regolith(layer.number("thickness_m", 1e-3, 10.0))) {
                thermal.layers.push_back(part);
            }
            continue;
        }
        thermal.layers.push_back({.thickness = layer.number("thickness_m", 1e-5, 100.0),
                                  .conductivity = layer.number("conductivity_W_mK", 0.005, 500.0),
                                  .density = layer.number("density_kg_m3", 0.1, 25000.0),
                                  .heat_capacity = layer.number("heat_capacity_J_kgK", 50.0, 2e4),
                                  .law = read_law(layer)});
    }
    if (thermal.layers.empty()) section.mistake("layers", "no layer, expected one or more");
}

/// The word under `kind`. An unknown one is a mistake of its own; the keys beside it are then taken
/// as known, for nobody can tell.
std::string read_kind(const Section& section, const std::string& fallback,
                      const std::vector<std::string>& words) {
    const std::string kind = section.word_or("kind", fallback, words);
    if (section.has("kind") && section.text_or("kind", kind) != kind) section.free_keys();
    return kind;
}

/// [[hour, value], ...] with ascending hours.
Schedule read_schedule(const Section& section, const char* key, const char* value, double least,
                       double most) {
    Schedule schedule;
    if (!section.has(key)) return schedule;
    for (const std::vector<double>& entry : section.rows(key, 2)) {
        const bool ascends = schedule.empty() || entry[0] > schedule.back()[0];
        if (!(entry[0] >= 0.0 && entry[0] <= 24.0 && entry[1] >= least && entry[1] <= most) ||
            !ascends) {
            section.mistake(key, fmt::format("expected [hour, {}] with ascending hours of 0 to 24 "
                                             "and values of {:g} to {:g}",
                                             value, least, most));
            break;
        }
        schedule.push_back({entry[0], entry[1]});
    }
    return schedule;
}

Bottom read_bottom(const Section& section) {
    const std::string kind = read_kind(section, "flux", {"flux", "temperature", "interior"});
    if (kind == "temperature") return FixedTemperature{section.number("value_K", 1.0, 3000.0)};
    if (kind == "interior") {
        Interior room{.air_temperature = section.number("air_temperature_K", 150.0, 1500.0),
                      .film = section.number("film_W_m2K", 0.0, 1e4)};
        room.schedule = read_schedule(section, "schedule", "temperature_K", 150.0, 1500.0);
        return room;
    }
    return FixedFlux{section.number_or("value_W_m2", 0.0, -1e5, 1e5)};
}

Convection read_convection(const Section& section) {
    const std::string kind = read_kind(section, "louis", {"louis", "tarp", "mowitt", "constant"});
    if (kind == "constant") return ConstantFilm{section.number("value_W_m2K", 0.0, 1e4)};
    if (kind == "tarp") return Tarp{};
    if (kind == "mowitt") return Mowitt{};
    return Louis{.least_film = section.number_or("least_W_m2K", 0.0, 0.0, 100.0)};
}

Evaporation read_evaporation(const Section& section) {
    const std::string kind = read_kind(section, "none", {"none", "resistance"});
    if (kind == "none") return {};
    return {.minimum_resistance = section.number("minimum_s_m", 0.0, 1e5),
            .wetness = section.number_or("wetness", 1.0, 0.0, 1.0)};
}

WaterStore read_store(const Section& section) {
    return {.capacity_mm = section.number("capacity_mm", 0.0, 1000.0),
            .wet_albedo = section.number_or("wet_albedo", -1.0, 0.0, 1.0)};
}

AgeingAlbedo read_snow_albedo(const Section& section) {
    AgeingAlbedo ageing;
    ageing.fresh = section.number_or("fresh", ageing.fresh, 0.0, 1.0);
    ageing.old = section.number_or("old", ageing.old, 0.0, ageing.fresh);
    return ageing;
}

Canopy read_canopy(const Section& section) {
    const std::string kind = read_kind(section, "none", {"none", "big_leaf", "two_source"});
    if (kind == "big_leaf") {
        return BigLeaf{.skin_conductance = section.number("skin_conductance_W_m2K", 0.01, 1e4)};
    }
    if (kind == "two_source") {
        return TwoSource{.leaf_area = section.number("leaf_area", 0.0, 12.0),
                         .leaf_resistance = section.number("leaf_resistance_s_m", 0.0, 1e5)};
    }
    return std::monostate{};
}

std::optional<ExposedBack> read_back(const Section& section) {
    const std::string kind = read_kind(section, "none", {"none", "exposed"});
    if (kind == "none") return std::nullopt;
    return ExposedBack{.emissivity = section.number("emissivity", 0.0, 1.0),
                       .albedo = section.number("albedo", 0.0, 1.0)};
}

}  // namespace

Material read_material(const Section& section, const MaterialLibrary& base,
                       const std::filesystem::path& folder, const std::string& name) {
    Material material;
    const std::vector<std::string> known = base.names();
    const auto is_known = [&](const std::string& word) {
        return std::find(known.begin(), known.end(), word) != known.end();
    };
    const std::string own_name = section.text_or("name", name);
    const std::string like = section.text_or("like", is_known(own_name) ? own_name : "");
    const bool fresh = like.empty();
    if (own_name.empty()) section.mistake("name", "missing, expected a text in quotes");
    if (is_known(like)) {
        material = base[base.find(like)];
    } else if (!fresh) {
        section.mistake("like", "no material '" + like.substr(0, 60) + "' above this one",
                        did_you_mean(like, known));
        material.reflectance = flat(0.0, 1.0);
    } else if (section.has("name") && !section.has("layers")) {
        section.mistake("name", "no material '" + own_name.substr(0, 60) + "' in the library",
                        did_you_mean(own_name, known));
        material.reflectance = flat(0.0, 1.0);
        return material;
    }
    material.name = own_name;
    read_optics(section, folder, fresh, material);
    read_finish(section, folder, material);

    ThermalSurface& thermal = material.thermal;
    if (fresh || section.has("roughness_length_m")) {
        thermal.roughness_length = section.number("roughness_length_m", 1e-6, 10.0);
        thermal.heat_roughness_length = thermal.roughness_length / 10.0;
    }
    thermal.heat_roughness_length =
        section.number_or("heat_roughness_length_m", thermal.heat_roughness_length, 1e-12, 10.0);
    read_layers(section, fresh, thermal);
    if (section.has("bottom")) thermal.bottom = read_bottom(section.section("bottom"));
    if (section.has("convection")) {
        thermal.convection = read_convection(section.section("convection"));
    }
    if (section.has("evaporation")) {
        thermal.evaporation = read_evaporation(section.section("evaporation"));
    }
    if (section.has("store")) thermal.store = read_store(section.section("store"));
    if (section.has("snow_albedo")) {
        thermal.snow_albedo = read_snow_albedo(section.section("snow_albedo"));
    }
    if (section.has("canopy")) thermal.canopy = read_canopy(section.section("canopy"));
    if (section.has("back")) thermal.back = read_back(section.section("back"));
    thermal.internal_heat =
        section.number_or("internal_heat_W_m2", thermal.internal_heat, -1e5, 1e6);
    if (section.has("internal_schedule")) {
        thermal.internal_schedule =
            read_schedule(section, "internal_schedule", "heat_W_m2", -1e5, 1e6);
    }
    return material;
}

}  // namespace diurna
