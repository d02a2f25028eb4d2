#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/run/picture.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// A scene driven by a program: advance in time, move an object, render a picture.
///
///     Stepper scene(read_scene("airfield.toml"));
///     scene.advance(parse_instant("2026-07-15T11:00:00-04:00"));
///     scene.put("truck", {192.0, 54.0}, 45.0);
///     scene.advance(later(scene.now(), 600.0));
///     Observer eye = scene.observer("nose");
///     eye.position.z() += 10.0;
///     const Picture picture = scene.picture("nose", eye);
///
/// The heat balance uses the scene's own steps, for any requested instants; temperatures
/// between steps are linear. A moved object affects the heat balance from the nearest step
/// on (like moves on trajectories: scenes/job/world/movers.hpp), pictures at once. Facets keep
/// their heat. View factors are recomputed for the step after a move, not for pictures
/// before it. The history before the span's start has all objects at their places in the
/// scene.
///
/// Instants from the span's start to its end; frames and sequences of the file are not used. The
/// same calls give the same bytes on any number of threads. Not for use from two threads at once.
class Stepper {
 public:
    /// Builds the world and checks all as a run does. Throws InputError.
    explicit Stepper(Scene scene);
    ~Stepper();
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    /// Initially the span's start.
    Instant now() const;

    /// Throws InputError for an instant before now, or after the span's end.
    void advance(Instant to);

    /// Moves an object that has a trajectory (it may be at rest) to another place: the pose of its
    /// frame (middle in plan and lowest point; right, front, up), tilted or not. Throws InputError
    /// for another object.
    void put(const std::string& object, const Eigen::Isometry3d& pose);
    /// The same on the ground at [east, north], with its usual stance
    /// (scenes/job/world/stance.hpp): on the slope or vertical, with its front at this heading
    /// clockwise from north. Throws InputError off the raster.
    void put(const std::string& object, const Eigen::Vector2d& place, double heading_deg);
    /// Its present pose.
    Eigen::Isometry3d pose(const std::string& object) const;

    /// [K] of World::surfaces() now.
    std::vector<float> temperature();
    const Prepared& prepared() const;

    /// An observer of the scene with the pose of its first picture: to be changed and passed to
    /// picture(). Throws InputError if none has that name.
    Observer observer(const std::string& name) const;
    /// Its present picture in its bands and cubes. Solves only what the present temperatures need.
    /// Throws InputError for an eye that is below the ground or inside an object.
    Picture picture(const std::string& observer, const Observer& pose);

    /// Steps of the heat balance solved so far, without those of the day before the start.
    int steps_solved() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
