#include "scenes/job/world/joined_columns.hpp"

#include <algorithm>
#include <variant>

namespace diurna {

bool plain_layers(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    return !surface.layers.empty() && !surface.snow_albedo && surface.internal_schedule.empty() &&
           !(room && !room->schedule.empty()) &&
           std::holds_alternative<std::monostate>(surface.canopy) &&
           std::all_of(surface.layers.begin(), surface.layers.end(), [](const Layer& layer) {
               return std::holds_alternative<Constant>(layer.law);
           });
}

JoinedColumns::JoinedColumns(const FacetSet& facets, const MaterialLibrary& materials,
                             NetworkObject& object)
    : facets_(facets), materials_(materials), object_(object) {
    for (std::uint32_t n = 0; n < object.size(); ++n) place_[object.facet[n]] = n;
}

std::uint32_t JoinedColumns::place_of(std::uint32_t facet) {
    const auto [at, is_new] = place_.try_emplace(facet, std::uint32_t(object_.size()));
    if (!is_new) return at->second;
    const MaterialId material = facets_.material[facet];
    const ThermalSurface& surface = materials_[material].thermal;
    HeatNetwork& network = object_.network;
    const auto [column, is_kind] =
        column_.try_emplace(material, std::uint32_t(network.column.size()));
    if (is_kind) network.column.push_back(network_column(surface.layers, surface.bottom));
    network.facet.push_back({.column = column->second, .area = double(facets_.area[facet])});
    object_.facet.push_back(facet);
    object_.back.push_back(no_number);
    object_.inner.push_back(NetworkObject::Inner::nothing);
    return at->second;
}

}  // namespace diurna
