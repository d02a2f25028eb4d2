#include "render/path/background.hpp"

#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

double axis_from_sun_deg(const Observer& observer, const RadianceInput& input) {
    return std::remainder(
        observer.azimuth_deg - degrees(std::atan2(input.to_sun.x(), input.to_sun.y())), 360.0);
}

std::vector<BackgroundTable> backgrounds(const View& view, const Observer& observer,
                                         std::span<const Band> bands, const RadianceInput& input,
                                         std::span<const std::optional<SunField>> scattered) {
    std::vector<BackgroundTable> tables;
    const ViewExtent& extent = view.extent;
    if (extent.sky_pixels == 0) return tables;
    const double eye_km = input.ground_height_km + 1e-3 * view.observer_height;
    const double axis = axis_from_sun_deg(observer, input);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        tables.emplace_back(input, bands[b], eye_km, extent.sky_zenith_deg[0],
                            extent.sky_zenith_deg[1]);
        if (scattered[b]) {
            tables.back().add_sunlight(input, bands[b], *scattered[b], eye_km,
                                       axis + double{extent.sky_azimuth_deg[0]},
                                       axis + double{extent.sky_azimuth_deg[1]});
        }
    }
    return tables;
}

}  // namespace diurna
