#include "scenes/job/run/behind_planes.hpp"

#include <algorithm>

#include "render/light/node_optics.hpp"
#include "render/view/seen_through.hpp"

namespace diurna {

namespace {

/// (material) what goes on behind it, the mean over a band's response.
std::vector<double> passed_in(const Band& band, const MaterialLibrary& materials) {
    std::vector<double> passed(materials.size(), 0.0);
    for (std::size_t m = 0; m < passed.size(); ++m) {
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        if (!material.see_through || material.transmittance.empty()) continue;
        for (std::size_t n = 0; n < band.node_um.size(); ++n) {
            passed[m] += band.weight[n] * optics_at(material, band.node_um[n]).transmittance;
        }
        passed[m] /= band.width_um();
    }
    return passed;
}

}  // namespace

std::vector<Plane> behind_planes(const View& view, const World& world, const RayScene& rays,
                                 const MaterialLibrary& materials, const Observer& observer,
                                 std::span<const Band> bands) {
    std::vector<Plane> planes;
    for (const Band& band : bands) {
        const std::vector<int> behind =
            seen_through(view, rays, world.facets, observer, passed_in(band, materials));
        if (behind.empty()) continue;
        Plane plane{"object_behind." + band.name, "1", std::vector<float>(view.pixels(), -1.0f)};
        std::copy(behind.begin(), behind.end(), plane.pixel.begin());
        planes.push_back(std::move(plane));
    }
    return planes;
}

}  // namespace diurna
