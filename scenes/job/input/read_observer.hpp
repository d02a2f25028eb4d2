#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "render/view/adaptive.hpp"
#include "render/view/observer.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_around.hpp"
#include "scenes/job/input/read_height.hpp"
#include "scenes/job/input/read_time.hpp"
#include "scenes/job/input/read_trajectory.hpp"
#include "scenes/job/input/scene_places.hpp"

namespace diurna {

struct ObserverInput {
    std::string name;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    HeightInput stands{.metres = 2.0};  // its eye
    std::optional<Around> around;       // replaces those two and the viewing direction
    std::string on;                     // object that it is mounted on, the same: its eye is at
    Eigen::Vector3d mount_place = Eigen::Vector3d::Zero();  // right, front, up of its frame [m]
    std::string trajectory;                  // that it follows; if mounted, that of its object
    std::optional<Eigen::Vector2d> look_at;  // a point of the ground,
    std::string look_at_object;              // or the middle of an object,
    /// or, on a trajectory or an object, azimuth to the right of the body's front, elevation, roll
    /// [deg],
    std::optional<Eigen::Vector3d> mount;
    // or the two angles:
    double azimuth_deg = 0.0, elevation_deg = 0.0, roll_deg = 0.0;
    Projection projection = Projection::pinhole;
    double horizontal_fov_deg = 20.0;
    double picture_width = 0.0;  // [m] orthographic
    int width = 640, height = 512;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // east, north, up [m s⁻¹]
    double row_time = 0.0, exposure = 0.0;               // [s]
    int samples = 16;
    std::optional<AdaptiveOptions> adaptive;  // adaptive sampling
    std::vector<std::string> bands;           // "3-5", "8-12", "lwir", a name of [[bands]]
    std::vector<std::string> cubes;           // names of [[cubes]]
    std::vector<std::string> instruments{};   // bands in which it has an [[instrument]]
    double pixel_pitch_um = 0.0;              // if given
    bool terms = false;                       // planes for the terms of the radiance, separately
    int surfaces = 0;                         // number of surfaces per pixel with separate planes
    std::vector<Instant> frames;              // its own, or the scene's
    std::string frames_note{};                // days without frames
    std::string where, look_where;  // position in the scene file: of its eye, of its target

    bool goes() const { return !trajectory.empty(); }
};

/// Names in a scene that observers may use.
struct ObserverReading {
    const ScenePlaces& places;
    const std::vector<BandInput>& bands;
    const std::vector<CubeInput>& cubes;
    const TerrainInput& terrain;
    const std::vector<TrajectoryInput>& trajectories;
    const TimeInput& time;
    const std::optional<Site>& site;
    Names objects;
};

/// One table [[observer]].
ObserverInput read_observer(const Section& section, const ObserverReading& reading);

}  // namespace diurna
