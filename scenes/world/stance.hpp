#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "scenes/input/object_input.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// How objects stand on sloping ground.
namespace diurna {

/// Where the frame of an object (the middle of its plan and its lowest point; right, front, up) is
/// and how it is turned.
struct Stance {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();  // east, north, up [m]
    double heading_deg = 0.0;                        // of its front, clockwise from north
    double pitch_deg = 0.0, roll_deg = 0.0;          // its front above, its right below the level

    bool level() const { return pitch_deg == 0.0 && roll_deg == 0.0; }
    /// From its frame to the site's.
    Eigen::Isometry3d pose() const;
    /// Takes off its pitch and roll, in the site's frame: a turn to how it is when level.
    Eigen::Matrix3d to_level() const;
};

/// Turns a level stance to the ground below: onto the plane that fits best, by least squares, the
/// raster at the object's contact points, which keeps its heading and its place in plan. Pitch and
/// roll are the plane's along and across the heading. Planes within 0.11 degrees of the level are
/// level (a level raster slopes by as much 13 km from the site), up to twice that less and less.
/// On a crest or in a hollow the object stands at the plane's height, not the ground's below its
/// middle, if the two differ by more than 1 cm.
///
/// - over_ground  [m] of `level.base`; beyond 0.5 m the slope counts less and less, beyond 1 m
///                nothing, unless the object says `stands = "on_slope"`
///
/// Unchanged of an object that stands upright, and where the raster has no ground below a point.
Stance on_slope(const ObjectInput& object, const Stance& level, double over_ground, const Dem& dem,
                const Site& site);

/// Of an object that stands somewhere, or is where its trajectory begins: what its keys say, or
/// on_slope(). Throws InputError(where) as stand_point().
Stance stance_of(const ObjectInput& object, const Dem& dem, const World& world,
                 const std::string& where);

/// That of its placing, which append_object() and append_copies() leave in it.
Stance stance_in(const Placing& placing);

}  // namespace diurna
