#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "scenes/input/read_trajectory.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Where and how a body on a way is at an instant.
struct PoseOnWay {
    Eigen::Vector3d place;        // east, north, up [m]
    Eigen::Quaterniond attitude;  // turns its right, forward, up to east, north, up
};

/// How a body goes [m/s] and turns [rad/s].
struct Motion {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), turning = Eigen::Vector3d::Zero();
};
Motion motion_between(const PoseOnWay& before, const PoseOnWay& after, double seconds);

/// A trajectory in the frame of a scene's site.
class Way {
 public:
    Way(const TrajectoryInput& input, const Dem& dem, const World& world);

    /// Throws InputError where its height is above ground that the raster does not have. A body
    /// that has no attitude of its own faces the way from 5 ms before to 5 ms after; while it
    /// rests, as it came, or before it has begun as it will go.
    PoseOnWay at(Instant when) const { return pose(seconds_between(start_, when)); }

    /// Its attitude, level but for a log's own pitch and roll: of a thing on wheels.
    PoseOnWay level(Instant when) const;
    /// Of a log that gives it.
    bool has_attitude() const { return !way_.attitude.empty(); }
    /// [m]; none of heights above the sea or the ellipsoid.
    std::optional<double> height_over_ground(Instant when) const;
    std::vector<Rest> rests() const { return diurna::rests(way_); }
    Instant start() const { return start_; }

    /// At an instant: from 5 ms before to 5 ms after, on the way.
    ///
    /// - attitude_of: of the body whose turning is asked for, at a pose on the way and its instant
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
    /// The way that a body goes or, while it rests, came [m]; not nought.
    Eigen::Vector3d going(double seconds) const;

    Trajectory way_;
    bool in_frame_ = false;  // heights are up of the site
    HeightOver heights_;
    Instant start_;
    std::string where_;
    const Dem* dem_;
    const World* world_;
};

}  // namespace diurna
