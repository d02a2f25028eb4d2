#pragma once

#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/plan/prepared.hpp"

namespace diurna {

/// What of a scene can be computed but is implausible: of its weather as it was
/// read (thermal/weather/weather_warnings.hpp), its places, its objects and what its observers see.
/// Each with the key that mends it; none is a mistake of the file. Takes a few rays per object and
/// observer, of large scenes a second.
std::vector<Mistake> scene_warnings(const Prepared& prepared);

/// Longitude and latitude where metres east and north of the site are asked for.
std::vector<Mistake> place_warnings(const Prepared& prepared);

/// Objects and buildings that reach into or stand inside one another, objects that float over the
/// ground or sink into it by half their height, and those of another size than things have.
/// Copies are compared where they are made (scenes/world/copied_objects.hpp).
std::vector<Mistake> object_warnings(const Prepared& prepared);

/// Objects whose contact points (scenes/world/stance.hpp) are buried in the ground or float above
/// it by more than 0.2 m, with both heights, along their trajectories too.
std::vector<Mistake> stand_warnings(const Prepared& prepared);

/// Observers that see the sky alone, or nothing but what stands right before their lens, and those
/// from which what they look at is hidden, or a hundredth of what looks down by a degree or more
/// looks beyond the raster.
std::vector<Mistake> view_warnings(const Prepared& prepared);

/// Files of shapes none of which lies within 100 km of the site, as where latitude and longitude
/// are exchanged.
std::vector<Mistake> shape_warnings(const Prepared& prepared);

/// Materials with schedules, where their clock (that of time.start) is not local mean solar time,
/// which earlier versions took.
std::vector<Mistake> clock_warnings(const Prepared& prepared);

/// Keys of [sky] that the scene's air replaces, and light on a tilted plane in the weather file.
std::vector<Mistake> light_warnings(const Prepared& prepared);

/// "scene.toml: object.truck: stands inside ... (move ...)", each once.
std::vector<std::string> as_lines(const std::vector<Mistake>& warnings);

}  // namespace diurna
