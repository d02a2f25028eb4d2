#pragma once

#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Input of a scene that can be computed but is implausible: its weather as read
/// (thermal/weather/weather_warnings.hpp), its places, its objects and its observers' views. Each
/// with the key to change; none is a mistake of the file. Takes a few rays per object and observer,
/// a second for large scenes.
std::vector<Mistake> scene_warnings(const Prepared& prepared);

/// Longitude and latitude given where metres east and north of the site are required.
std::vector<Mistake> place_warnings(const Prepared& prepared);

/// Objects and buildings that overlap or are inside one another, objects above the ground or sunk
/// into it by half their height, and those of implausible size. Copies are compared when they are
/// placed (scenes/job/world/copied_objects.hpp).
std::vector<Mistake> object_warnings(const Prepared& prepared);

/// Objects whose contact points (scenes/job/world/stance.hpp) are more than 0.2 m below or above
/// the ground, with both heights, also along their trajectories.
std::vector<Mistake> stand_warnings(const Prepared& prepared);

/// Observers that see only sky, or only something directly in front of their lens, those whose
/// target is hidden, and those with more than a hundredth of the directions that point down by a
/// degree or more ending beyond the raster.
std::vector<Mistake> view_warnings(const Prepared& prepared);

/// Files of shapes with none within 100 km of the site, for example with latitude and longitude
/// exchanged.
std::vector<Mistake> shape_warnings(const Prepared& prepared);

/// Land cover that does not cover the ground, with its share; classes on the ground without a
/// material, with their shares, and classes of the table that are not there; class numbers that
/// were interpolated.
std::vector<Mistake> land_cover_warnings(const Prepared& prepared);

/// Materials with schedules, if their clock (that of time.start) is not local mean solar time,
/// which earlier versions used.
std::vector<Mistake> clock_warnings(const Prepared& prepared);

/// Keys of [sky] that the scene's air replaces, and light on a tilted plane in the weather file.
std::vector<Mistake> light_warnings(const Prepared& prepared);

/// Steps that are longer than the weather's rows, where sunlight changes between the steps by more
/// than 25 W/m² rms: clouds of minutes.
std::vector<Mistake> step_warnings(const Prepared& prepared);

/// "scene.toml: object.truck: stands inside ... (move ...)", each once.
std::vector<std::string> as_lines(const std::vector<Mistake>& warnings);

}  // namespace diurna
