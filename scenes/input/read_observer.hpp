#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "render/view/adaptive.hpp"
#include "render/view/observer.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/input/read_around.hpp"
#include "scenes/input/read_height.hpp"
#include "scenes/input/read_time.hpp"
#include "scenes/input/read_trajectory.hpp"
#include "scenes/input/scene_places.hpp"

namespace diurna {

struct ObserverInput {
    std::string name;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    HeightInput stands{.metres = 2.0};  // its eye
    std::optional<Around> around;       // in place of those two and where it looks
    std::string on;                     // object that it rides on, likewise: its eye is at
    Eigen::Vector3d mount_place = Eigen::Vector3d::Zero();  // right, front, up of its frame [m]
    std::string trajectory;                  // that it goes, likewise; one that rides its object's
    std::optional<Eigen::Vector2d> look_at;  // a point of the ground,
    std::string look_at_object;              // or the middle of an object,
    /// or, of one on a trajectory or an object, azimuth to the right of the body's front,
    /// elevation, roll [deg],
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
    std::optional<AdaptiveOptions> adaptive;  // samples where pixels need them
    std::vector<std::string> bands;           // "3-5", "8-12", "lwir", a name of [[bands]]
    std::vector<std::string> cubes;           // names of [[cubes]]
    std::vector<std::string> instruments{};   // bands in which it has an [[instrument]]
    double pixel_pitch_um = 0.0;              // if it says one
    bool terms = false;                       // planes for the terms of the radiance, one by one
    int surfaces = 0;                         // of each pixel that have planes of their own
    std::vector<Instant> frames;              // its own, or the scene's
    std::string frames_note{};                // days that have none
    std::string where, look_where;  // in the scene file: of where its eye is, what it sees

    bool goes() const { return !trajectory.empty(); }
};

/// What of a scene its observers may name.
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
