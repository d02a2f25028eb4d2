#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "scenes/job/input/read_time.hpp"
#include "scenes/job/world/objects.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Directions towards the sun over the months of a span, day by day and hour by hour. Whole months,
/// so that another part of a day, or the next day, has the same ground.
class SunCourses {
 public:
    SunCourses(const Site& site, const TimeInput& time);

    std::size_t days() const { return days_; }
    std::size_t hours() const { return hours_; }
    /// Unit vector; zero if the sun is lower than 11.5 degrees.
    const Eigen::Vector3d& at(std::size_t day, std::size_t hour) const {
        return direction_[day * hours_ + hour];
    }

 private:
    std::size_t days_ = 0, hours_ = 0;
    std::vector<Eigen::Vector3d> direction_;  // (day, hour)
};

/// Refined ground for the shadows of one object, or of copies of it, at places above the ground:
/// everywhere its shadows may fall. As rows of tiles of one lattice whose borders fit point by
/// point, outside the squares of refined ground below the objects.
///
/// The edges are a fifth of the object's width (the second largest of its three sizes), half
/// of the penumbra's width, or those of the ground below it, whichever is the longest, longer
/// if there would be more than some 10 000 triangles. Shadows with a penumbra of three object
/// widths or more are ignored. None for objects lower than one edge of the ground around
/// them.
///
/// - base: middle of its plan and lowest point, of each place or copy: east, north, up [m]
std::vector<GroundPatch> shadow_tracks(const ObjectInput& object,
                                       std::span<const Eigen::Vector3d> base, const SunCourses& sun,
                                       const Dem& dem, const Site& site);

}  // namespace diurna
