#include "scenes/plan/sequence.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
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

/// The middle of the box around an object.
Eigen::Vector3d middle_of(const World& world, const std::string& name) {
    const auto found = std::find(world.objects.begin(), world.objects.end(), name);
    const auto id = static_cast<ObjectId>(found - world.objects.begin());
    Eigen::AlignedBox3d box;
    const FacetSet& facets = world.facets;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.object[f] != id) continue;
        for (const std::uint32_t corner : facets.corner[f]) {
            box.extend(facets.vertex[corner].cast<double>());
        }
    }
    if (box.isEmpty()) {
        throw InputError("observer", fmt::format("looks at \"{}\", which has no surface", name));
    }
    return box.center();
}

/// What an observer looks at, if it looks at something.
std::optional<Eigen::Vector3d> target_of(const ObserverInput& input, const Scene& scene,
                                         const Dem& dem, const World& world) {
    if (input.look_at) {
        const std::string where =
            fmt::format("{}: observer \"{}\"", scene.file.string(), input.name);
        return ground_point(dem, world.site, *input.look_at, where);
    }
    if (!input.look_at_object.empty()) return middle_of(world, input.look_at_object);
    return std::nullopt;
}

/// Of an observer on a way.
std::vector<Observer> poses_on_way(const ObserverInput& input, const Way& way,
                                   const std::optional<Eigen::Vector3d>& target) {
    const Observer camera = camera_of(input);
    const auto pointed = [&](const PoseOnWay& body) {
        Observer observer = camera;
        observer.position = body.place;
        if (target) return looking_at(observer, *target);
        if (!input.mount) return observer;
        const Eigen::Vector3d& angle = *input.mount;
        return turned_to(observer, body.attitude * attitude(angle.x(), angle.y(), angle.z()));
    };
    std::vector<Observer> poses(input.frames.size());
    for_each_index(poses.size(), [&](std::size_t i) {
        const Instant when = input.frames[i];
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
                     const World& world) {
    Sequence sequence{.frame = input.frames, .pose = {}, .goes = input.goes()};
    const auto target = target_of(input, scene, dem, world);
    if (sequence.goes) {
        const Way way(*find_trajectory(scene.trajectories, input.trajectory), dem, world);
        sequence.pose = poses_on_way(input, way, target);
        return sequence;
    }
    const std::string where = fmt::format("{}: observer \"{}\"", scene.file.string(), input.name);
    Observer observer = camera_of(input);
    observer.position = ground_point(dem, world.site, input.place, where) +
                        Eigen::Vector3d(0.0, 0.0, input.height_above_ground);
    sequence.pose = {target ? looking_at(observer, *target) : observer};
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
                                const RayScene& rays) {
    std::vector<Sequence> all;
    for (const ObserverInput& input : scene.observers) {
        all.push_back(sequence_of(input, scene, dem, world));
        check_poses(all.back(), world, rays);
    }
    return all;
}

std::vector<Instant> all_frames(const std::vector<Sequence>& sequences) {
    std::vector<Instant> all;
    for (const Sequence& sequence : sequences) {
        all.insert(all.end(), sequence.frame.begin(), sequence.frame.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace diurna
