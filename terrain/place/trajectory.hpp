#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace diurna {

/// A trajectory: position and attitude of a body over time.
struct Trajectory {
    std::vector<double> seconds;         // ascending, two or more
    std::vector<Eigen::Vector3d> place;  // (second) east, north and a height [m]
    /// (second) rotates the body's right, forward, up to east, north, up; empty: along its path.
    std::vector<Eigen::Quaterniond> attitude{};
    /// Between the seconds: straight at constant speed, or (three places or more) a cubic curve
    /// whose velocity at each place is that of the parabola through it and its neighbours; zero
    /// where the body is at rest.
    bool smooth = false;

    double begin() const { return seconds.front(); }
    double end() const { return seconds.back(); }
};

/// Position within its seconds; outside, that of the nearest end.
Eigen::Vector3d place_at(const Trajectory& way, double seconds);

/// For a trajectory with attitudes: the shortest rotation between two, at a constant rate.
Eigen::Quaterniond attitude_at(const Trajectory& way, double seconds);

/// A body's attitude from the angles of a log: heading clockwise from north, its front `pitch`
/// above level, its right side `roll` below level, rotated in that order.
Eigen::Quaterniond attitude(double heading_deg, double pitch_deg, double roll_deg);

/// Attitude of a body that moves along a velocity (east, north, up) without roll; at rest or in
/// vertical motion its front is to the north.
Eigen::Quaterniond attitude_along(const Eigen::Vector3d& velocity);

/// Period in which a body stays in one place (to a centimetre): if the body is at rest at the first
/// or last second, it is at rest before or after without end.
struct Rest {
    double from, until;  // [s]
};
///
/// - metres: per unit of its places' first two coordinates (for degrees: 111 km)
std::vector<Rest> rests(const Trajectory& way, double metres = 1.0);

/// Seconds at which a body reaches consecutive places at constant speed [m s⁻¹], from 0 on.
std::vector<double> seconds_at_speed(const std::vector<Eigen::Vector3d>& place, double speed);

/// A smooth curve through three places or more, at constant speed [m s⁻¹] within 1 %.
Trajectory smooth_at_speed(const std::vector<Eigen::Vector3d>& place, double speed);

}  // namespace diurna
