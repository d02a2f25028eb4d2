#include "render/path/view_backgrounds.hpp"

#include <cmath>

#include "materials/base/units.hpp"
#include "render/path/direction_angles.hpp"

namespace diurna {

double axis_from_sun_deg(const Observer& observer, const RadianceInput& input) {
    return std::remainder(observer.azimuth_deg - degrees(azimuth_of(input.to_sun)), 360.0);
}

std::vector<BackgroundTable> view_backgrounds(const View& view, const Observer& observer,
                                              std::span<const BandLight> bands,
                                              const RadianceInput& input) {
    std::vector<BackgroundTable> tables;
    const ViewExtent& seen = view.extent;
    if (seen.sky_pixels == 0) return tables;
    const double eye_km = input.above_sea_km(view.observer_height);
    const double axis = axis_from_sun_deg(observer, input);
    const BackgroundTable::Extent extent{
        .least_zenith_deg = seen.sky_zenith_deg[0],
        .most_zenith_deg = seen.sky_zenith_deg[1],
        .least_azimuth_deg = axis + double{seen.sky_azimuth_deg[0]},
        .most_azimuth_deg = axis + double{seen.sky_azimuth_deg[1]}};
    for (const BandLight& band : bands) tables.emplace_back(input, band, eye_km, extent);
    return tables;
}

}  // namespace diurna
