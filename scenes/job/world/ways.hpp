#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "scenes/job/input/read_trajectory.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Pose of a body on a trajectory at an instant.
struct PoseOnWay {
    Eigen::Vector3d place;        // east, north, up [m]
    Eigen::Quaterniond attitude;  // rotates its right, forward, up to east, north, up
};

/// Velocity [m/s] and angular velocity [rad/s] of a body.
struct Motion {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), turning = Eigen::Vector3d::Zero();
};
Motion motion_between(const PoseOnWay& before, const PoseOnWay& after, double seconds);

/// A trajectory in the frame of a scene's site.
class Way {
 public:
    Way(const TrajectoryInput& input, const Dem& dem, const World& world);

    /// Throws InputError if its height is above ground that the raster does not have. A body
    /// without its own attitude faces along its path from 5 ms before to 5 ms after; at rest, in
    /// the direction of its last motion, or before the start of its first.
    PoseOnWay at(Instant when) const { return pose(seconds_between(start_, when)); }

    /// Its attitude, level except for a log's own pitch and roll: for wheeled objects.
    PoseOnWay level(Instant when) const;
    /// Whether the log gives attitudes.
    bool has_attitude() const { return !way_.attitude.empty(); }
    /// [m]; nothing for heights above the sea or the ellipsoid.
    std::optional<double> height_over_ground(Instant when) const;
    std::vector<Rest> rests() const { return diurna::rests(way_); }
    Instant start() const { return start_; }

    /// At an instant: from 5 ms before to 5 ms after, on the trajectory.
    ///
    /// - attitude_of: attitude of the body, for a pose on the trajectory and its instant
    template <class AttitudeOf>
    Motion motion(Instant when, const AttitudeOf& attitude_of) const {
        const auto [from, to] = around(seconds_between(start_, when));
        const auto body = [&](double seconds) {
            const PoseOnWay at = pose(seconds);
            return PoseOnWay{at.place, attitude_of(at, later(start_, seconds))};
        };
        return motion_between(body(from), body(to), to - from);
    }

 private:
    struct Around {
        double from, to;
    };
    Around around(double seconds) const;
    Eigen::Vector3d place(double seconds) const;
    PoseOnWay pose(double seconds) const;
    /// Direction of motion or, at rest, of the last motion [m]; not zero.
    Eigen::Vector3d going(double seconds) const;

    Trajectory way_;
    bool in_frame_ = false;  // heights are the site's up coordinate
    HeightOver heights_;
    Instant start_;
    std::string where_;
    const Dem* dem_;
    const World* world_;
};

}  // namespace diurna
