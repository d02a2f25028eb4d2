#include "scenes/job/world/ways.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/job/input/sea_height.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"

namespace diurna {

namespace {

/// A place of a file of latitudes and longitudes. Where its height is above the ground only east
/// and north count.
Eigen::Vector3d from_geodetic(const World& world, HeightOver heights, const Eigen::Vector3d& at) {
    const SceneFrame frame{world.site, world.sea_level_height};
    const double height = heights == HeightOver::ground ? world.site.height
                          : heights == HeightOver::sea
                              ? at.z() + sea_at(frame, {at.y(), at.x(), 0.0})
                              : at.z();
    Eigen::Vector3d local = to_local(world.site, Geodetic{at.y(), at.x(), height});
    if (heights == HeightOver::ground) local.z() = at.z();
    return local;
}

}  // namespace

Motion motion_between(const PoseOnWay& before, const PoseOnWay& after, double seconds) {
    const Eigen::AngleAxisd turn(after.attitude * before.attitude.conjugate());
    return {(after.place - before.place) / seconds, turn.angle() / seconds * turn.axis()};
}

Way::Way(const TrajectoryInput& input, const Dem& dem, const World& world)
    : way_(input.way),
      in_frame_(input.geodetic && input.heights != HeightOver::ground),
      heights_(input.heights),
      start_(input.start),
      where_(input.where),
      dem_(&dem),
      world_(&world) {
    if (!input.geodetic) return;
    for (Eigen::Vector3d& at : way_.place) at = from_geodetic(world, heights_, at);
}

Way::Around Way::around(double seconds) const {
    constexpr double half = 5e-3;
    const double from = std::clamp(seconds - half, way_.begin(), way_.end() - half);
    return {from, std::min(way_.end(), std::max(seconds + half, from + half))};
}

Eigen::Vector3d Way::place(double seconds) const {
    const Eigen::Vector3d at = place_at(way_, seconds);
    if (in_frame_) return at;
    if (heights_ == HeightOver::ground) {
        const Eigen::Vector3d ground =
            ground_point(*dem_, world_->site, at.head<2>(), where_,
                         "set heights = \"sea\" in the trajectory, with heights above the sea");
        return ground + Eigen::Vector3d(0.0, 0.0, at.z());
    }
    return stand_point(*world_, *dem_, at.head<2>(), {at.z(), heights_}, where_);
}

Eigen::Vector3d Way::going(double seconds) const {
    constexpr double least = 1e-5;  // [m]
    const auto [from, to] = around(seconds);
    const Eigen::Vector3d here = place(to) - place(from);
    if (here.head<2>().norm() > least) return here;
    Eigen::Vector3d found = Eigen::Vector3d::UnitY();
    for (const Rest& rest : rests()) {
        const bool ends = std::isfinite(rest.until);
        if (ends && (found == Eigen::Vector3d::UnitY() || rest.until < seconds)) {
            found = place(rest.until + 0.01) - place(rest.until);  // as it will go
        }
        if (std::isfinite(rest.from) && rest.from <= seconds + 0.01) {
            found = place(rest.from) - place(rest.from - 0.01);  // as it came
        }
    }
    return found;
}

PoseOnWay Way::pose(double seconds) const {
    if (!way_.attitude.empty()) return {place(seconds), attitude_at(way_, seconds)};
    return {place(seconds), attitude_along(going(seconds))};
}

std::optional<double> Way::height_over_ground(Instant when) const {
    if (heights_ != HeightOver::ground) return std::nullopt;
    return place_at(way_, seconds_between(start_, when)).z();
}

PoseOnWay Way::level(Instant when) const {
    const double seconds = seconds_between(start_, when);
    if (!way_.attitude.empty()) return pose(seconds);
    Eigen::Vector3d ahead = going(seconds);
    ahead.z() = 0.0;
    return {place(seconds), attitude_along(ahead)};
}

}  // namespace diurna
