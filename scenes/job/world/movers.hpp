#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/ways.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// Objects that move along trajectories.
namespace diurna {

/// Places those of a scene that is being built at the start of their trajectories: its facets and
/// their order are then independent of the span.
void put_at_begin(Scene& scene, const Dem& dem, const World& world);

/// The pose of an object at every instant, moving or at rest.
class ObjectCourse {
 public:
    /// - object, dem, world: must outlive it
    ///
    /// Throws InputError if both its keys and its trajectory's file give its attitude.
    ObjectCourse(const ObjectInput& object, const Scene& scene, const Dem& dem, const World& world);
    /// From its own frame (its middle in plan and lowest point; right, front, up) to the site's. On
    /// a trajectory without attitudes it is tilted with the ground (stance.hpp).
    Eigen::Isometry3d at(Instant when) const;
    /// The same as angles, without the pitch and roll of a trajectory's own attitude.
    Stance stance(Instant when) const;
    /// Velocity of that frame's origin, and its rotation: from 5 ms before to 5 ms after.
    Motion motion(Instant when) const;

 private:
    PoseOnWay pose(Instant when) const;

    const ObjectInput* object_;
    const Dem* dem_;
    Site site_;
    std::optional<Way> way_;
    Eigen::Isometry3d still_ = Eigen::Isometry3d::Identity();
};

/// Poses of the moving objects, (mover) of World::movers.
using MoverPoses = std::vector<Eigen::Isometry3d>;
/// Poses `seconds` later, with straight motion and rotation at a constant rate.
MoverPoses gone_on(const MoverPoses& poses, const std::vector<Motion>& motions, double seconds);

/// Motion as treated in the heat balance: periods at rest, with each move made at once in its
/// middle, at the nearest step.
struct Movement {
    std::vector<Instant> stage;  // start of stages at rest; the first is the span's
    std::vector<bool> early{};   // (stage) a move has its middle after the start: then the start
                                 // itself still belongs to the previous stage
    std::vector<MoverPoses> at_stage{};         // (stage)
    std::vector<Instant> frame{};               // ascending: of pictures
    std::vector<MoverPoses> at_frame{};         // (frame)
    std::vector<std::vector<Motion>> motion{};  // (frame) (mover)
    std::vector<bool> under_way{};              // (frame) whether one is not at its stage's place
    double longest_move = 0.0;                  // [s]

    bool none() const { return at_stage.empty() || at_stage.front().empty(); }
    std::size_t stage_of(Instant when) const;
    const MoverPoses& poses_at(Instant frame_instant) const;
    const std::vector<Motion>& motions_at(Instant frame_instant) const;
    bool is_under_way(Instant frame_instant) const;
    /// Whether one moves or rotates at that instant.
    bool moves_at(Instant frame_instant) const;
};

/// - frames: ascending
/// - steps: of the heat balance, ascending
Movement movement(const Scene& scene, const Dem& dem, const World& world,
                  std::span<const Instant> frames, std::span<const Instant> steps);

/// Facets with the moving objects at other places.
FacetSet moved(const World& world, FacetSet facets, const MoverPoses& poses);
/// The world in the same way.
World moved(const World& world, const MoverPoses& poses);

}  // namespace diurna
