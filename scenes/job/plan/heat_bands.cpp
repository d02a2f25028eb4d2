#include "scenes/job/plan/heat_bands.hpp"

#include <utility>

#include "materials/atmosphere/bins.hpp"

namespace diurna {

std::vector<Band> heat_bands(const Scene& scene, const ObserverInput& observer) {
    constexpr double heat_from_um = 3.0;
    std::vector<Band> bands;
    for (const std::string& name : observer.bands) {
        Band band = named_band(scene.bands, name, bin_edges_um());
        if (band.to_um() > heat_from_um) bands.push_back(std::move(band));
    }
    return bands;
}

}  // namespace diurna
