#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/run/picture.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// A scene that a program drives: go on in time, put an object elsewhere, take a picture.
///
///     Stepper scene(read_scene("airfield.toml"));
///     scene.advance(parse_instant("2026-07-15T11:00:00-04:00"));
///     scene.put("truck", {192.0, 54.0}, 45.0);
///     scene.advance(later(scene.now(), 600.0));
///     Observer eye = scene.observer("nose");
///     eye.position.z() += 10.0;
///     const Picture picture = scene.picture("nose", eye);
///
/// Heat goes by the scene's own steps, whatever instants are asked for; temperatures in between lie
/// straight between the two steps. What is put elsewhere counts in the heat balance from the
/// nearest step on (as moves of trajectories do: scenes/world/movers.hpp), in pictures at once.
/// Facets keep their heat. What a facet sees of others is worked out anew for the step after a
/// move, not for pictures before it. The past of the span's start is with all objects where the
/// scene has them then.
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

    /// At first the span's start.
    Instant now() const;

    /// Throws InputError for an instant before now, or after the span's end.
    void advance(Instant to);

    /// Puts an object that has a trajectory (be it one that rests) somewhere else: where its frame
    /// (middle in plan and lowest point; right, front, up) is to be, upright or not. Throws
    /// InputError for another object.
    void put(const std::string& object, const Eigen::Isometry3d& pose);
    /// The same on the ground at [east, north], as it stands there (scenes/world/stance.hpp): on
    /// the slope or upright, its front so many degrees clockwise from north. Throws InputError off
    /// the raster.
    void put(const std::string& object, const Eigen::Vector2d& place, double heading_deg);
    /// Where it is.
    Eigen::Isometry3d pose(const std::string& object) const;

    /// [K] of World::surfaces() now.
    std::vector<float> temperature();
    const Prepared& prepared() const;

    /// An observer of the scene as its first picture has it: to be changed and handed in below.
    /// Throws InputError where none has that name.
    Observer observer(const std::string& name) const;
    /// What it sees now in its bands and cubes. Solves nothing but what temperatures of now need.
    /// Throws InputError for an eye that is below the ground or inside an object.
    Picture picture(const std::string& observer, const Observer& pose);

    /// Steps of the heat balance solved so far, those of the day before the start skipped.
    int steps_solved() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
