#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"

namespace diurna {

/// (material) whether its facets belong to a target, whose facets are a thermal network.
inline std::vector<bool> of_networks(const Scene& scene, const World& world) {
    std::vector<bool> of(scene.materials.size(), false);
    for (const TargetFacets& target : world.targets) {
        for (const auto& [material, part] : target.part) of[index(material)] = true;
    }
    return of;
}

/// Facets of targets.
inline std::size_t network_facets(const Scene& scene, const World& world) {
    const std::vector<bool> of = of_networks(scene, world);
    const auto& material = world.facets.material;
    return static_cast<std::size_t>(std::count_if(material.begin(), material.end(),
                                                  [&](MaterialId id) { return of[index(id)]; }));
}

}  // namespace diurna
