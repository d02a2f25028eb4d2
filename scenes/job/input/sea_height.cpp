#include "scenes/job/input/sea_height.hpp"

#include "terrain/raster/geoid.hpp"

namespace diurna {

double sea_at(const SceneFrame& frame, const Geodetic& place) {
    const double at_site = frame.site.height - frame.sea_level_height;
    return at_site == 0.0 ? 0.0 : geoid_heights({&place, 1}).front();
}

}  // namespace diurna
