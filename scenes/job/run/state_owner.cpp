#include "scenes/job/run/state_owner.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

#include "scenes/job/store/digest.hpp"
#include "thermal/solve/point_facets.hpp"

namespace diurna {

namespace {

template <class T>
void add_bytes(const std::vector<T>& values, std::string& bytes) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string owner_text(const ThermalLaw& law) {
    if (const auto* r = std::get_if<Radiating>(&law)) {
        return fmt::format(" radiating {} {}", r->cubic, fmt::join(r->heat, " "));
    }
    if (const auto* f = std::get_if<Freezing>(&law)) {
        return fmt::format(" freezing {} {} {}", f->water, f->frozen_conductivity,
                           f->frozen_heat_capacity);
    }
    if (const auto* m = std::get_if<Melting>(&law)) return fmt::format(" melting {}", m->held);
    return "";
}

std::string owner_text(const Bottom& bottom) {
    if (const auto* t = std::get_if<FixedTemperature>(&bottom)) {
        return fmt::format("{} K", t->temperature);
    }
    if (const auto* flux = std::get_if<FixedFlux>(&bottom)) {
        return fmt::format("{} W m-2", flux->flux);
    }
    const auto& room = std::get<Interior>(bottom);
    return fmt::format("room {} K {} W m-2 K-1", room.air_temperature, room.film);
}

std::string column_of(const Material& material) {
    const ThermalSurface& surface = material.thermal;
    std::string text = material.name + ":";
    for (const Layer& layer : surface.layers) {
        text += fmt::format(" {} m {} W m-1 K-1 {} kg m-3 {} J kg-1 K-1{};", layer.thickness,
                            layer.conductivity, layer.density, layer.heat_capacity,
                            owner_text(layer.law));
    }
    text += surface.back ? " air behind" : " below " + owner_text(surface.bottom);
    if (point_need(surface) == PointNeed::always) text += "; solved by itself";
    return text;
}

}  // namespace

StateOwner state_owner(const FacetSet& facets, const MaterialLibrary& materials) {
    StateOwner owner;
    std::map<std::size_t, std::uint32_t> turn;  // of materials, as facets come
    std::vector<std::uint32_t> of_facet;
    for (const MaterialId id : facets.material) {
        const auto [place, is_new] = turn.try_emplace(index(id), std::uint32_t(turn.size()));
        if (is_new) owner.columns.push_back(column_of(materials[id]));
        of_facet.push_back(place->second);
    }
    std::string bytes = DIURNA_VERSION;  // another version may cut columns into other modes
    add_bytes(facets.vertex, bytes);
    add_bytes(facets.corner, bytes);
    add_bytes(of_facet, bytes);
    owner.mesh = fmt::format("{} facets, SHA-256 {}", facets.size(), sha256(bytes));
    return owner;
}

}  // namespace diurna
