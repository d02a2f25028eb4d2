#include "scenes/job/plan/aspect_place.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "scenes/job/world/upright_box.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

Eigen::Vector3d middle_of(const World& world, const std::string& name, double heading_deg) {
    const auto found = std::find(world.objects.begin(), world.objects.end(), name);
    const auto id = static_cast<ObjectId>(found - world.objects.begin());
    const auto box = upright_box(object_facets(world, id), id, heading_deg);
    if (!box) {
        throw InputError("observer", fmt::format("looks at \"{}\", which has no surface", name));
    }
    return box->middle;
}

Observer placed_around(Observer observer, const Around& around, const World& world) {
    const Eigen::Vector3d middle = middle_of(world, around.object, around.heading_deg);
    observer.position = middle + around.range * direction(around.heading_deg + around.aspect_deg,
                                                          around.elevation_deg);
    return looking_at(observer, middle);
}

}  // namespace diurna
