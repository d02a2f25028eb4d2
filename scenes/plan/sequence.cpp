#include "scenes/plan/sequence.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/plan/aspect_place.hpp"
#include "scenes/world/ground_point.hpp"
#include "scenes/world/ways.hpp"
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
    Target(const ObserverInput& input, const Scene& scene, const Dem& dem, const World& world,
           const Movement& movement)
        : movement_(movement) {
        if (input.look_at) {
            const std::string where =
                fmt::format("{}: observer \"{}\"", scene.file.string(), input.name);
            at_ = ground_point(dem, world.site, *input.look_at, where);
        } else if (!input.look_at_object.empty()) {
            at_ = middle_of(world, input.look_at_object,
                            heading_of(scene.terrain, input.look_at_object));
            for (std::size_t m = 0; m < world.movers.size(); ++m) {
                const std::size_t object = world.movers[m].object;
                if (scene.terrain.objects[object].name != input.look_at_object) continue;
                mover_ = m;
                at_ = world.movers[m].start.inverse() * *at_;
            }
        }
    }
    bool goes() const { return mover_.has_value(); }
    /// At an instant of a frame.
    std::optional<Eigen::Vector3d> at(Instant when) const {
        if (!mover_) return at_;
        return movement_.poses_at(when)[*mover_] * *at_;
    }

 private:
    const Movement& movement_;
    std::optional<Eigen::Vector3d> at_;  // of one that goes in its own frame
    std::optional<std::size_t> mover_;
};

/// Of an observer on a way.
std::vector<Observer> poses_on_way(const ObserverInput& input, const Way& way,
                                   const Target& target) {
    const Observer camera = camera_of(input);
    std::vector<Observer> poses(input.frames.size());
    for_each_index(poses.size(), [&](std::size_t i) {
        const Instant when = input.frames[i];
        const auto looked_at = target.at(when);
        const auto pointed = [&](const PoseOnWay& body) {
            Observer observer = camera;
            observer.position = body.place;
            if (looked_at) return looking_at(observer, *looked_at);
            if (!input.mount) return observer;
            const Eigen::Vector3d& angle = *input.mount;
            return turned_to(observer, body.attitude * attitude(angle.x(), angle.y(), angle.z()));
        };
        poses[i] = pointed(way.at(when));
        if (!camera.takes_time()) return;
        const Way::Motion motion =
            way.motion(when, [&](const PoseOnWay& body) { return attitude_of(pointed(body)); });
        poses[i].velocity = motion.velocity;
        poses[i].turning = motion.turning;
    });
    return poses;
}

Sequence sequence_of(const ObserverInput& input, const Scene& scene, const Dem& dem,
                     const World& world, const Movement& movement) {
    const Target target(input, scene, dem, world, movement);
    Sequence sequence{.frame = input.frames, .pose = {}, .goes = input.goes() || target.goes()};
    if (input.goes()) {
        const Way way(*find_trajectory(scene.trajectories, input.trajectory), dem, world);
        sequence.pose = poses_on_way(input, way, target);
        return sequence;
    }
    const std::string where = fmt::format("{}: observer \"{}\"", scene.file.string(), input.name);
    Observer observer = camera_of(input);
    if (input.around) {
        sequence.pose = {placed_around(observer, *input.around, world)};
        return sequence;
    }
    observer.position = ground_point(dem, world.site, input.place, where) +
                        Eigen::Vector3d(0.0, 0.0, input.height_above_ground);
    if (!target.goes()) {
        const auto at = target.at({});
        sequence.pose = {at ? looking_at(observer, *at) : observer};
        return sequence;
    }
    for (const Instant when : sequence.frame) {
        sequence.pose.push_back(looking_at(observer, *target.at(when)));
    }
    return sequence;
}

/// The first mistake of all places, with its instant.
void check_poses(const Sequence& sequence, const World& world, const RayScene& rays) {
    for (std::size_t i = 0; i < sequence.pose.size(); ++i) {
        try {
            check_observer(sequence.pose[i], world.facets, rays, world.ground_facets,
                           world.objects);
        } catch (const InputError& error) {
            if (!sequence.goes) throw;
            const Mistake& mistake = error.mistakes().front();
            throw InputError(
                mistake.where,
                fmt::format("at {}: {}", format_instant(sequence.frame[i]), mistake.problem),
                mistake.hint);
        }
    }
}

}  // namespace

std::vector<Sequence> sequences(const Scene& scene, const Dem& dem, const World& world,
                                const RayScene& rays, const Movement& movement) {
    std::vector<Sequence> all;
    for (const ObserverInput& input : scene.observers) {
        all.push_back(sequence_of(input, scene, dem, world, movement));
        check_poses(all.back(), world, rays);
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
