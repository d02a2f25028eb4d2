#include "scenes/job/world/movers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/heights.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

namespace {

const TrajectoryInput& way_of(const ObjectInput& object, const Scene& scene) {
    return *find_trajectory(scene.trajectories, object.trajectory);
}

/// A move, from a rest's end to the next one's begin, within the span.
struct Move {
    Instant from, to;
    std::size_t mover;
    Instant middle() const { return later(from, 0.5 * seconds_between(from, to)); }
};
std::vector<Move> moves_of(const TrajectoryInput& way, std::size_t mover, const Scene& scene) {
    std::vector<Move> moves;
    const std::vector<Rest> all = rests(way.way, way.metres());
    for (std::size_t i = 1; i < all.size(); ++i) {
        const Move move{later(way.start, all[i - 1].until), later(way.start, all[i].from), mover};
        if (move.to > scene.time.start && move.from < scene.time.end()) moves.push_back(move);
    }
    return moves;
}

Instant nearest_step(Instant when, std::span<const Instant> steps) {
    const auto after = std::lower_bound(steps.begin(), steps.end(), when);
    if (after == steps.end()) return steps.back();
    if (after == steps.begin()) return steps.front();
    const auto before = std::prev(after);
    return seconds_between(*before, when) < seconds_between(when, *after) ? *before : *after;
}

/// The step from which on the heat balance has a move done. One at the span's start that comes to
/// its middle later: the next, as what went before the span is with all where they start; a balance
/// of means has no such past, and one that goes on from a state has its own.
Instant step_of(const Move& move, const Scene& scene, std::span<const Instant> steps) {
    const Instant middle = move.middle(), nearest = nearest_step(middle, steps);
    const SpanStart begin = scene.time.spin_up;
    const bool has_past = begin != SpanStart::steady && begin != SpanStart::state;
    const bool starts = nearest == steps.front() && middle > nearest && steps.size() > 2;
    return has_past && starts ? steps[1] : nearest;
}

void move_object(FacetSet& facets, ObjectId id, const Eigen::Isometry3d& by) {
    std::vector<bool> done(facets.vertex.size(), false);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.object[f] != id) continue;
        for (const std::uint32_t v : facets.corner[f]) {
            if (done[v]) continue;
            done[v] = true;
            facets.vertex[v] = (by * facets.vertex[v].cast<double>()).cast<float>();
        }
        facets.centroid[f] = (by * facets.centroid[f].cast<double>()).cast<float>();
        facets.normal[f] =
            (by.linear() * facets.normal[f].cast<double>()).normalized().cast<float>();
    }
}

}  // namespace

ObjectCourse::ObjectCourse(const ObjectInput& object, const Scene& scene, const Dem& dem,
                           const World& world)
    : object_(&object), dem_(&dem), site_(world.site) {
    if (object.trajectory.empty()) {
        still_ = stance_of(object, dem, world, object.where).pose();
        return;
    }
    way_.emplace(way_of(object, scene), dem, world);
    if (!object.angles_given || !way_->has_attitude()) return;
    throw InputError(object.where,
                     fmt::format("object \"{}\" has pitch_deg or roll_deg as well as the "
                                 "trajectory \"{}\", whose file has the attitude",
                                 object.name, object.trajectory),
                     "remove one of them");
}

Stance ObjectCourse::stance(Instant when) const {
    const PoseOnWay level = way_->level(when);
    const Eigen::Vector3d ahead = level.attitude.toRotationMatrix().col(1);
    Stance stance{.base = level.place, .heading_deg = degrees(std::atan2(ahead.x(), ahead.y()))};
    if (object_->angles_given) {
        stance.pitch_deg = object_->placing.pitch_deg;
        stance.roll_deg = object_->placing.roll_deg;
    } else if (const auto over_ground = way_->height_over_ground(when);
               over_ground && !way_->has_attitude()) {
        stance = on_slope(*object_, stance, *over_ground, *dem_, site_);
    }
    return stance;
}

PoseOnWay ObjectCourse::pose(Instant when) const {
    const Stance turned = stance(when);
    if (turned.level()) return way_->level(when);
    return {turned.base, attitude(turned.heading_deg, turned.pitch_deg, turned.roll_deg)};
}

Eigen::Isometry3d ObjectCourse::at(Instant when) const {
    if (!way_) return still_;
    const PoseOnWay there = pose(when);
    Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
    to.linear() = there.attitude.toRotationMatrix();
    to.translation() = there.place;
    return to;
}

Motion ObjectCourse::motion(Instant when) const {
    if (!way_) return {};
    constexpr double half = 5e-3;
    return motion_between(pose(later(when, -half)), pose(later(when, half)), 2.0 * half);
}

MoverPoses gone_on(const MoverPoses& poses, const std::vector<Motion>& motions, double seconds) {
    MoverPoses there = poses;
    for (std::size_t m = 0; m < there.size(); ++m) {
        const double angle = motions[m].turning.norm() * seconds;
        if (angle != 0.0) {
            there[m].linear() =
                Eigen::AngleAxisd(angle, motions[m].turning.normalized()) * poses[m].linear();
        }
        there[m].translation() += seconds * motions[m].velocity;
    }
    return there;
}

void put_at_begin(Scene& scene, const Dem& dem, const World& world) {
    for (ObjectInput& object : scene.terrain.objects) {
        if (object.trajectory.empty()) continue;
        const Eigen::Isometry3d pose =
            ObjectCourse(object, scene, dem, world).at(way_of(object, scene).begin());
        object.place = pose.translation().head<2>();
        const Eigen::Vector3d ahead = pose.linear().col(1);
        object.placing.heading_deg = degrees(std::atan2(ahead.x(), ahead.y()));
    }
}

std::size_t Movement::stage_of(Instant when) const {
    const auto after = std::upper_bound(stage.begin() + 1, stage.end(), when);
    const auto k = static_cast<std::size_t>(after - stage.begin()) - 1;
    return k > 0 && early[k] && when == stage[k] ? k - 1 : k;
}

namespace {

std::size_t place_of(const std::vector<Instant>& frames, Instant when) {
    const auto at = std::lower_bound(frames.begin(), frames.end(), when);
    return static_cast<std::size_t>(at - frames.begin());
}

}  // namespace

const MoverPoses& Movement::poses_at(Instant frame_instant) const {
    return at_frame[place_of(frame, frame_instant)];
}

const std::vector<Motion>& Movement::motions_at(Instant frame_instant) const {
    return motion[place_of(frame, frame_instant)];
}

bool Movement::moves_at(Instant frame_instant) const {
    const std::vector<Motion>& all = motions_at(frame_instant);
    return std::any_of(all.begin(), all.end(), [](const Motion& one) {
        return one.velocity.norm() > 1e-6 || one.turning.norm() > 1e-6;
    });
}

bool Movement::is_under_way(Instant frame_instant) const {
    return under_way[place_of(frame, frame_instant)];
}

Movement movement(const Scene& scene, const Dem& dem, const World& world,
                  std::span<const Instant> frames, std::span<const Instant> steps) {
    Movement movement{.stage = {scene.time.start}};
    std::vector<Move> moves;
    std::vector<ObjectCourse> course;  // (mover)
    for (std::size_t m = 0; m < world.movers.size(); ++m) {
        const ObjectInput& object = scene.terrain.objects[world.movers[m].object];
        course.emplace_back(object, scene, dem, world);
        for (const Move& move : moves_of(way_of(object, scene), m, scene)) {
            moves.push_back(move);
            movement.stage.push_back(step_of(move, scene, steps));
            movement.longest_move =
                std::max(movement.longest_move, seconds_between(move.from, move.to));
        }
    }
    std::sort(movement.stage.begin(), movement.stage.end());
    movement.stage.erase(std::unique(movement.stage.begin(), movement.stage.end()),
                         movement.stage.end());
    if (movement.stage.back() == scene.time.end() && movement.stage.size() > 1) {
        movement.stage.pop_back();
    }
    for (const Instant begin : movement.stage) {
        movement.early.push_back(std::any_of(moves.begin(), moves.end(), [&](const Move& move) {
            return step_of(move, scene, steps) == begin && move.middle() > begin;
        }));
    }
    // In a stage an object rests where the last move before has led, or where the first begins.
    for (const Instant begin : movement.stage) {
        std::vector<Instant> rest(world.movers.size(), scene.time.start);
        std::vector<bool> found(world.movers.size(), false);
        for (const Move& move : moves) {
            if (step_of(move, scene, steps) <= begin) {
                rest[move.mover] = move.to;
                found[move.mover] = true;
            } else if (!found[move.mover]) {
                rest[move.mover] = move.from;
                found[move.mover] = true;
            }
        }
        MoverPoses& poses = movement.at_stage.emplace_back();
        for (std::size_t m = 0; m < rest.size(); ++m) {
            poses.push_back(course[m].at(rest[m]));
        }
    }
    if (world.movers.empty()) return movement;
    movement.frame.assign(frames.begin(), frames.end());
    for (const Instant when : frames) {
        MoverPoses& poses = movement.at_frame.emplace_back();
        std::vector<Motion>& motions = movement.motion.emplace_back();
        for (const ObjectCourse& of : course) {
            poses.push_back(of.at(when));
            motions.push_back(of.motion(when));
        }
        const MoverPoses& rest = movement.at_stage[movement.stage_of(when)];
        movement.under_way.push_back(
            !std::equal(poses.begin(), poses.end(), rest.begin(),
                        [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
                            return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() < 1e-3;
                        }));
    }
    return movement;
}

FacetSet moved(const World& world, FacetSet facets, const MoverPoses& poses) {
    for (std::size_t m = 0; m < poses.size(); ++m) {
        const Eigen::Isometry3d by = poses[m] * world.movers[m].start.inverse();
        if (by.isApprox(Eigen::Isometry3d::Identity(), 1e-12)) continue;
        move_object(facets, world.movers[m].id, by);
    }
    return facets;
}

World moved(const World& world, const MoverPoses& poses) {
    World there = world;
    there.facets = moved(world, std::move(there.facets), poses);
    if (!there.texture_levels.empty()) {
        there.texture_levels.facets = moved(world, std::move(there.texture_levels.facets), poses);
    }
    for (std::size_t m = 0; m < poses.size(); ++m) {
        const Eigen::Isometry3d by = poses[m] * world.movers[m].start.inverse();
        for (TargetFacets& target : there.targets) {
            if (target.id == world.movers[m].id) target.pose = by * target.pose;
        }
        there.movers[m].start = poses[m];
    }
    return there;
}

}  // namespace diurna
