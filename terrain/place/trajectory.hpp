#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace diurna {

/// A way through space: where a body is at each second, and how it is turned.
struct Trajectory {
    std::vector<double> seconds;         // ascending, two or more
    std::vector<Eigen::Vector3d> place;  // (second) east, north and a height [m]
    /// (second) turns the body's right, forward, up to east, north, up; empty: it faces its way.
    std::vector<Eigen::Quaterniond> attitude{};
    /// Between the seconds: straight at even speed, or a cubic curve that has at each place the
    /// velocity of the parabola through it and its neighbours, of three places or more; none where
    /// it rests.
    bool smooth = false;

    double begin() const { return seconds.front(); }
    double end() const { return seconds.back(); }
};

/// Within its seconds; at the nearest end beyond them.
Eigen::Vector3d place_at(const Trajectory& way, double seconds);

/// Of a way that has attitudes: the shortest turn between two, at an even rate.
Eigen::Quaterniond attitude_at(const Trajectory& way, double seconds);

/// A body's attitude by the angles of a log: heading clockwise from north, its front above the
/// level by `pitch`, its right side below it by `roll`, turned in that order.
Eigen::Quaterniond attitude(double heading_deg, double pitch_deg, double roll_deg);

/// That of a body that goes along a velocity (east, north, up) without a roll; of one that stands
/// still or goes straight up or down, with its front to the north.
Eigen::Quaterniond attitude_along(const Eigen::Vector3d& velocity);

/// From when until when a body on a way stays in one place (to a centimetre): the first rest lasts
/// from for ever to its begin or longer, the last one goes on for ever.
struct Rest {
    double from, until;  // [s]
};
///
/// - metres: of a unit of its places' first two parts (of a degree: 111 km)
std::vector<Rest> rests(const Trajectory& way, double metres = 1.0);

/// Seconds at which a body reaches places one after the other at an even speed [m s⁻¹], from 0 on.
std::vector<double> seconds_at_speed(const std::vector<Eigen::Vector3d>& place, double speed);

/// A smooth curve through three places or more, gone along at an even speed [m s⁻¹] within 1 %.
Trajectory smooth_at_speed(const std::vector<Eigen::Vector3d>& place, double speed);

}  // namespace diurna
