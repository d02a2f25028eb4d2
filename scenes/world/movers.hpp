#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/stance.hpp"
#include "scenes/world/ways.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// Objects that go along trajectories.
namespace diurna {

/// Puts those of a scene that is to be built where their ways begin: whatever its span, its facets
/// are the same in the same order.
void put_at_begin(Scene& scene, const Dem& dem, const World& world);

/// Where an object is at every instant, whether it goes or stands.
class ObjectCourse {
 public:
    /// - object, dem, world: to outlive it
    ///
    /// Throws InputError where both its keys and its trajectory's file give its attitude.
    ObjectCourse(const ObjectInput& object, const Scene& scene, const Dem& dem, const World& world);
    /// From its own frame (its middle in plan and lowest point; right, front, up) to the site's. On
    /// a trajectory that gives no attitude it lies on the ground as that slopes (stance.hpp).
    Eigen::Isometry3d at(Instant when) const;
    /// The same as angles, without the pitch and roll that a trajectory's own attitude has.
    Stance stance(Instant when) const;
    /// Of that frame's origin, and its turn: from 5 ms before to 5 ms after.
    Motion motion(Instant when) const;

 private:
    PoseOnWay pose(Instant when) const;

    const ObjectInput* object_;
    const Dem* dem_;
    Site site_;
    std::optional<Way> way_;
    Eigen::Isometry3d still_ = Eigen::Isometry3d::Identity();
};

/// Where the objects that go are, (mover) of World::movers.
using MoverPoses = std::vector<Eigen::Isometry3d>;
/// So many seconds later, each going straight on and turning at an even rate.
MoverPoses gone_on(const MoverPoses& poses, const std::vector<Motion>& motions, double seconds);

/// How the heat balance sees them go: at rest in turn, each move at once in its middle, on the
/// nearest step.
struct Movement {
    std::vector<Instant> stage;  // begins of stages in which all rest; the first is the span's
    std::vector<bool> early{};   // (stage) a move comes to its middle after the begin: then all is
                                 // still as in the stage before at the begin itself
    std::vector<MoverPoses> at_stage{};         // (stage)
    std::vector<Instant> frame{};               // ascending: of pictures
    std::vector<MoverPoses> at_frame{};         // (frame)
    std::vector<std::vector<Motion>> motion{};  // (frame) (mover)
    std::vector<bool> under_way{};  // (frame) whether one is elsewhere than in its stage
    double longest_move = 0.0;      // [s]

    bool none() const { return at_stage.empty() || at_stage.front().empty(); }
    std::size_t stage_of(Instant when) const;
    const MoverPoses& poses_at(Instant frame_instant) const;
    const std::vector<Motion>& motions_at(Instant frame_instant) const;
    bool is_under_way(Instant frame_instant) const;
    /// Whether one goes or turns just then.
    bool moves_at(Instant frame_instant) const;
};

/// - frames: ascending
/// - steps: of the heat balance, ascending
Movement movement(const Scene& scene, const Dem& dem, const World& world,
                  std::span<const Instant> frames, std::span<const Instant> steps);

/// Facets with the objects that go in other places.
FacetSet moved(const World& world, FacetSet facets, const MoverPoses& poses);
/// The world likewise.
World moved(const World& world, const MoverPoses& poses);

}  // namespace diurna
