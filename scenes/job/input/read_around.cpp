#include "scenes/job/input/read_around.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "scenes/job/input/object_names.hpp"

namespace diurna {

Eigen::Vector2d Around::eye() const {
    const double azimuth = radians(heading_deg + aspect_deg);
    const double level = range * std::cos(radians(elevation_deg));
    return place + level * Eigen::Vector2d(std::sin(azimuth), std::cos(azimuth));
}

Around read_around(const Section& section, const TerrainInput& terrain) {
    Names known{.what = "object or building", .known = {}};
    add_objects(known, terrain);
    for (const Building& building : terrain.buildings) known.known.push_back(building.name);
    Around around{
        .object = section.name("object", "object or building, at whose centre it looks", known),
        .range = section.number("range_m", "distance from its centre", {0.1, 200000.0}),
        .aspect_deg = section.number_or("aspect_deg",
                                        "direction of the observer as seen from the object: 0 in "
                                        "front of it, 90 on its right-hand side",
                                        0.0, {-360.0, 360.0}),
        .elevation_deg =
            section.number_or("elevation_deg", "elevation of the observer as seen from the object",
                              0.0, {-90.0, 90.0}),
        .draw_again = section.choice_or(
            "if_hidden",
            "action where relief or other objects hide at least 90 % of the object: warn (printed "
            "by `diurna check`), or draw_again: draw another aspect at the same range by "
            "scene.seed, and a higher elevation if no aspect is free",
            false, {{"warn", false}, {"draw_again", true}})};
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != around.object) continue;
        around.heading_deg = object.placing.heading_deg;
        around.place = object.place;
        return around;
    }
    for (const Building& building : terrain.buildings) {
        if (building.name != around.object) continue;
        around.heading_deg = building.heading_deg;
        around.place = building.place;
        break;
    }
    return around;
}

}  // namespace diurna
