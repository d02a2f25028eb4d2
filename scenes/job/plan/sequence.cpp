#include "scenes/job/plan/sequence.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/plan/aspect_place.hpp"
#include "scenes/job/plan/drawn_aspect.hpp"
#include "scenes/job/plan/eye_check.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/ways.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

namespace {

/// What stays the same of an observer wherever it is.
Observer camera_of(const ObserverInput& input) {
    return {.name = input.name,
            .azimuth_deg = input.azimuth_deg,
            .elevation_deg = input.elevation_deg,
            .roll_deg = input.roll_deg,
            .horizontal_fov_deg = input.horizontal_fov_deg,
            .width = input.width,
            .height = input.height,
            .projection = input.projection,
            .picture_width = input.picture_width,
            .velocity = input.velocity,
            .row_time = input.row_time,
            .exposure = input.exposure};
}

/// The way that an object or a building faces; ground has none.
double heading_of(const TerrainInput& terrain, const std::string& name) {
    for (const ObjectInput& object : terrain.objects) {
        if (object.name == name) return object.placing.heading_deg;
    }
    for (const Building& building : terrain.buildings) {
        if (building.name == name) return building.heading_deg;
    }
    return 0.0;
}

/// What an observer looks at, if it looks at something: a place, which may go.
class Target {
 public:
    Target(const ObserverInput& input, const Scene& scene, const Dem& dem, const World& world) {
        if (input.look_at) {
            at_ = ground_point(dem, world.site, *input.look_at, input.look_where);
        } else if (!input.look_at_object.empty()) {
            at_ = middle_of(world, input.look_at_object,
                            heading_of(scene.terrain, input.look_at_object));
            for (const Mover& mover : world.movers) {
                const ObjectInput& object = scene.terrain.objects[mover.object];
                if (object.name != input.look_at_object) continue;
                course_.emplace(object, scene, dem, world);
                at_ = mover.start.inverse() * *at_;
            }
        }
    }
    bool goes() const { return course_.has_value(); }
    std::optional<Eigen::Vector3d> at(Instant when) const {
        if (!course_) return at_;
        return course_->at(when) * *at_;
    }

 private:
    std::optional<Eigen::Vector3d> at_;  // of one that goes in its own frame
    std::optional<ObjectCourse> course_;
};

/// looking_at() with the place of the mistake in the scene file.
Observer pointed_at(const ObserverInput& input, const Observer& from, const Eigen::Vector3d& at) {
    if (from.position == at) {
        throw InputError(input.look_where, "is the camera's own place, expected another place");
    }
    return looking_at(from, at);
}

/// The camera on a body at an instant, as it is mounted, or turned to what it looks at.
Observer pointed(const ObserverInput& input, const PoseOnWay& body, const Target& target,
                 Instant when) {
    Observer observer = camera_of(input);
    observer.position = body.place;
    if (const auto looked_at = target.at(when)) return pointed_at(input, observer, *looked_at);
    if (!input.mount) return observer;
    const Eigen::Vector3d& angle = *input.mount;
    return turned_to(observer, body.attitude * attitude(angle.x(), angle.y(), angle.z()));
}

/// Of an observer on a way.
std::vector<Observer> poses_on_way(const ObserverInput& input, const Way& way,
                                   const Target& target) {
    std::vector<Observer> poses(input.frames.size());
    for_each_index(poses.size(), [&](std::size_t i) {
        const Instant when = input.frames[i];
        poses[i] = pointed(input, way.at(when), target, when);
        if (!poses[i].takes_time()) return;
        const Motion motion = way.motion(when, [&](const PoseOnWay& body, Instant at) {
            return attitude_of(pointed(input, body, target, at));
        });
        poses[i].velocity = motion.velocity;
        poses[i].turning = motion.turning;
    });
    return poses;
}

/// Of an observer on a body that is somewhere at every instant; its motion is that from 5 ms before
/// to 5 ms after.
template <class BodyAt>
std::vector<Observer> poses_on(const ObserverInput& input, const BodyAt& body_at,
                               const Target& target) {
    constexpr double half = 5e-3;
    std::vector<Observer> poses(input.frames.size());
    for_each_index(poses.size(), [&](std::size_t i) {
        const Instant when = input.frames[i];
        poses[i] = pointed(input, body_at(when), target, when);
        if (!poses[i].takes_time()) return;
        const auto camera = [&](Instant at) {
            const Observer there = pointed(input, body_at(at), target, at);
            return PoseOnWay{there.position, attitude_of(there)};
        };
        const Motion motion =
            motion_between(camera(later(when, -half)), camera(later(when, half)), 2.0 * half);
        if (!input.on.empty()) poses[i].velocity = motion.velocity;
        poses[i].turning = motion.turning;
    });
    return poses;
}

/// Where the eye of one that rides on an object is, and how that is turned.
std::vector<Observer> poses_riding(const ObserverInput& input, const Scene& scene, const Dem& dem,
                                   const World& world, const Target& target) {
    const auto object = std::find_if(scene.terrain.objects.begin(), scene.terrain.objects.end(),
                                     [&](const ObjectInput& one) { return one.name == input.on; });
    const ObjectCourse course(*object, scene, dem, world);
    const auto body_at = [&](Instant when) {
        const Eigen::Isometry3d at = course.at(when);
        return PoseOnWay{at * input.mount_place, Eigen::Quaterniond(at.linear())};
    };
    return poses_on(input, body_at, target);
}

Sequence sequence_of(const ObserverInput& input, const Scene& scene, const Dem& dem,
                     const World& world, const RayScene& rays, const EyeCheck& check,
                     const Movement& movement) {
    const Target target(input, scene, dem, world);
    Sequence sequence{
        .frame = input.frames, .pose = {}, .note = {}, .goes = input.goes() || target.goes()};
    if (!input.on.empty()) {
        sequence.pose = poses_riding(input, scene, dem, world, target);
        if (!sequence.goes) sequence.pose.resize(1);
        return sequence;
    }
    if (input.goes()) {
        const Way way(*find_trajectory(scene.trajectories, input.trajectory), dem, world);
        sequence.pose = poses_on_way(input, way, target);
        return sequence;
    }
    Observer observer = camera_of(input);
    if (input.around) {
        const MoverPoses poses = movement.none() ? MoverPoses{} : movement.at_stage.front();
        DrawnAspect drawn =
            drawn_aspect(observer, *input.around, world, rays, check, poses, scene.seed);
        sequence.pose = {drawn.observer};
        sequence.note = std::move(drawn.note);
        return sequence;
    }
    observer.position = stand_point(world, dem, input.place, input.stands, input.where);
    if (!target.goes()) {
        const auto at = target.at({});
        sequence.pose = {at ? pointed_at(input, observer, *at) : observer};
        return sequence;
    }
    const PoseOnWay stand{observer.position, Eigen::Quaterniond::Identity()};
    sequence.pose = poses_on(
        input, [&](Instant) { return stand; }, target);
    return sequence;
}

/// The first mistake of all places, with its instant.
void check_poses(const Sequence& sequence, const std::string& where, const EyeCheck& check,
                 const Movement& movement) {
    const bool many = sequence.goes || !movement.none();
    for (std::size_t i = 0; i < (many ? sequence.frame.size() : sequence.pose.size()); ++i) {
        try {
            check.check(sequence.at(i),
                        movement.none() ? MoverPoses{} : movement.poses_at(sequence.frame[i]));
        } catch (const InputError& error) {
            const Mistake& mistake = error.mistakes().front();
            const std::string when =
                many ? fmt::format("at {}: ", format_instant(sequence.frame[i])) : "";
            throw InputError(where, when + mistake.problem, mistake.hint);
        }
    }
}

}  // namespace

std::vector<Sequence> sequences(const Scene& scene, const Dem& dem, const World& world,
                                const RayScene& rays, const Movement& movement) {
    std::vector<Sequence> all;
    const EyeCheck check(world, rays);
    for (const ObserverInput& input : scene.observers) {
        all.push_back(sequence_of(input, scene, dem, world, rays, check, movement));
        check_poses(all.back(), input.where, check, movement);
    }
    return all;
}

std::vector<Instant> frames_of(const Scene& scene) {
    std::vector<Instant> all;
    for (const ObserverInput& observer : scene.observers) {
        all.insert(all.end(), observer.frames.begin(), observer.frames.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace diurna
