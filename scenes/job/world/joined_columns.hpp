#pragma once

#include <cstdint>
#include <map>

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "thermal/solve/network_object.hpp"

namespace diurna {

/// Whether a surface has plain layers, which a target's network can use: no leaves, snow, freezing
/// water, schedules.
bool plain_layers(const ThermalSurface& surface);

/// A target's network with further facets of the scene as separate columns, such as the ground
/// below it.
class JoinedColumns {
 public:
    /// All arguments must outlive it.
    JoinedColumns(const FacetSet& facets, const MaterialLibrary& materials, NetworkObject& object);

    bool has(std::uint32_t facet) const { return place_.count(facet) > 0; }
    /// The network's facet for a scene's facet; one of plain layers is added.
    std::uint32_t place_of(std::uint32_t facet);

 private:
    const FacetSet& facets_;
    const MaterialLibrary& materials_;
    NetworkObject& object_;
    std::map<std::uint32_t, std::uint32_t> place_;
    std::map<MaterialId, std::uint32_t> column_;
};

}  // namespace diurna
