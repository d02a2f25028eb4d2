#include "scenes/job/world/stance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "materials/base/units.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

namespace {

/// up = height + slope · (east, north from the place)
struct GroundPlane {
    double height = 0.0;  // [m]
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// Through the ground below a stance's contact points.
std::optional<GroundPlane> plane_below(const std::vector<Eigen::Vector3d>& contact,
                                       const Stance& stance, const Dem& dem, const Site& site) {
    const Eigen::Isometry3d pose = stance.pose();
    const auto count = static_cast<Eigen::Index>(contact.size());
    Eigen::MatrixXd system(count, 3);
    Eigen::VectorXd height(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Vector2d at = (pose * contact[std::size_t(i)]).head<2>();
        const auto ground = ground_if_any(dem, site, at);
        if (!ground) return std::nullopt;
        system.row(i) << 1.0, at.x() - stance.base.x(), at.y() - stance.base.y();
        height[i] = ground->z();
    }
    const Eigen::Vector3d found = system.completeOrthogonalDecomposition().solve(height);
    return GroundPlane{found[0], found.tail<2>()};
}

/// The angles of a body that heads as before on a plane of a slope.
void turn_onto(const Eigen::Vector2d& slope, Stance& stance) {
    const double heading = radians(stance.heading_deg);
    const Eigen::Vector2d ahead(std::sin(heading), std::cos(heading));
    const Eigen::Vector3d up = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
    const Eigen::Vector3d front =
        Eigen::Vector3d(ahead.x(), ahead.y(), slope.dot(ahead)).normalized();
    stance.pitch_deg = degrees(std::atan(slope.dot(ahead)));
    stance.roll_deg = degrees(std::atan2(-front.cross(up).z(), up.z()));
}

/// How far the slope counts at a height above the ground, 0 to 1.
double share_at_height(double over_ground) {
    constexpr double near = 0.5;  // [m]
    return std::clamp(2.0 - std::abs(over_ground) / near, 0.0, 1.0);
}

/// How far a slope counts, 0 to 1.
double share_of_slope(double slope) {
    constexpr double level = 2e-3;
    return std::clamp(slope / level - 1.0, 0.0, 1.0);
}

/// How far a plane counts that is so much higher or lower than the ground at the middle [m]: on a
/// crest or in a hollow the contact points' plane is level, but not at the middle's height.
double share_of_lift(double lift) {
    constexpr double even = 0.01;
    return std::clamp(std::abs(lift) / even - 1.0, 0.0, 1.0);
}

}  // namespace

Eigen::Isometry3d Stance::pose() const {
    Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
    to.linear() = attitude(heading_deg, pitch_deg, roll_deg).toRotationMatrix();
    to.translation() = base;
    return to;
}

Eigen::Matrix3d Stance::to_level() const {
    if (level()) return Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d upright = attitude(heading_deg, 0.0, 0.0).toRotationMatrix();
    return upright * pose().linear().transpose();
}

Stance on_slope(const ObjectInput& object, const Stance& level, double over_ground, const Dem& dem,
                const Site& site) {
    constexpr int passes = 3;  // the points' places in plan depend on the angles
    const double near = object.at_any_height ? 1.0 : share_at_height(over_ground);
    if (!object.on_slope || near == 0.0) return level;
    Stance stance = level;
    double share = 0.0;
    GroundPlane plane;
    for (int pass = 0; pass < passes; ++pass) {
        const auto found = plane_below(object.contact, stance, dem, site);
        if (!found) return level;
        plane = *found;
        share = near * share_of_slope(plane.slope.norm());
        if (share == 0.0) break;
        turn_onto(share * plane.slope, stance);
    }
    const double lift = plane.height - (level.base.z() - over_ground);
    stance.base.z() += std::max(share, near * share_of_lift(lift)) * lift;
    return stance;
}

Stance stance_of(const ObjectInput& object, const Dem& dem, const World& world,
                 const std::string& where) {
    const Stance level{.base = stand_point(world, dem, object.place, object.stands, where),
                       .heading_deg = object.placing.heading_deg,
                       .pitch_deg = object.angles_given ? object.placing.pitch_deg : 0.0,
                       .roll_deg = object.angles_given ? object.placing.roll_deg : 0.0};
    return on_slope(object, level, object.stands.metres, dem, world.site);
}

Stance stance_in(const Placing& placing) {
    return {placing.base, placing.heading_deg, placing.pitch_deg, placing.roll_deg};
}

}  // namespace diurna
