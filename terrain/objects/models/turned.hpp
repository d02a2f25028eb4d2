#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "terrain/objects/models/workpiece.hpp"

/// Solids of revolution.
namespace diurna {

/// A point of the profile; the segment from it to the next belongs to `part`.
struct ProfilePoint {
    double radius, along;  // [m]
    std::string part;
};

/// A closed solid: the profile, from axis to axis, rotated about it. Circles have their first
/// vertex directly below the axis (for a vertical axis: at the back).
///
/// finest  maximum number of corners of circles
void add_turned(Workpiece& work, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                const std::vector<ProfilePoint>& profile, int finest = 64);

/// The number of corners of a circle, a multiple of four.
int circle_corners(const Fineness& fine, double radius, int finest = 64);

/// A round bar with flat ends between two places: four-sided at low detail.
void add_bar(Workpiece& work, const std::string& part, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to, double radius);

/// A cylinder with rounded ends.
void add_drum(Workpiece& work, const std::string& part, const Eigen::Vector3d& from,
              const Eigen::Vector3d& to, double radius, double rounding);

/// A wheel upright on the ground: a tyre with rounded shoulders on a dished disc.
///
/// centre  of its hub; its axle lies along x
void add_wheel(Workpiece& work, const Eigen::Vector3d& centre, double radius, double width,
               const std::string& tyre = "wheels", const std::string& disc = "discs");

}  // namespace diurna
