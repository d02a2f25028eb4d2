#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "scenes/job/input/object_input.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// Stance of objects on sloping ground.
namespace diurna {

/// Position and attitude of an object's frame (the middle of its plan and its lowest point; right,
/// front, up).
struct Stance {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();  // east, north, up [m]
    double heading_deg = 0.0;                        // of its front, clockwise from north
    double pitch_deg = 0.0, roll_deg = 0.0;          // its front above, its right below level

    bool level() const { return pitch_deg == 0.0 && roll_deg == 0.0; }
    /// From its frame to the site's.
    Eigen::Isometry3d pose() const;
    /// Removes its pitch and roll, in the site's frame: a rotation to its level position.
    Eigen::Matrix3d to_level() const;
};

/// Tilts a level stance with the ground: to the plane that fits the raster best, by least squares,
/// at the object's contact points; heading and place in plan are unchanged. Pitch and roll are the
/// plane's along and across the heading. Planes within 0.11 degrees of level count as level (a
/// level raster has that slope 13 km from the site), with a gradual transition up to twice that. On
/// a crest or in a hollow the object is at the plane's height, not the ground's below its middle,
/// if the two differ by more than 1 cm.
///
/// - over_ground  [m] of `level.base`; beyond 0.5 m the slope counts less and less, beyond 1 m not
///                at all, unless the object has `stands = "on_slope"`
///
/// Unchanged for an object that stays vertical, and if the raster has no ground below a point.
Stance on_slope(const ObjectInput& object, const Stance& level, double over_ground, const Dem& dem,
                const Site& site);

/// For an object at rest, or at the start of its trajectory: the stance given by its keys, or
/// on_slope(). Throws InputError(where) as stand_point().
Stance stance_of(const ObjectInput& object, const Dem& dem, const World& world,
                 const std::string& where);

/// The stance stored in its placing by append_object() and append_copies().
Stance stance_in(const Placing& placing);

}  // namespace diurna
