#pragma once

#include <Eigen/Core>
#include <string>

#include "terrain/facets.hpp"
#include "terrain/ray_scene.hpp"

namespace diurna {

/// A pinhole camera that stands still: pose, field of view and size of its picture.
///
/// Pixels are square. Column 0, row 0 is the upper left one; its centre lies at (0.5, 0.5).
struct Observer {
    std::string name = "observer";
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // east, north, up [m]
    double azimuth_deg = 0.0;          // of the optical axis, clockwise from true north
    double elevation_deg = 0.0;        // above the horizontal, −90 to 90
    double roll_deg = 0.0;             // the camera turned clockwise about its axis
    double horizontal_fov_deg = 20.0;  // from the left edge to the right, 0.001 to 170
    int width = 640, height = 512;     // [pixels]
};

/// Throws InputError if a value is not finite or out of its range.
void check_observer(const Observer& observer);

/// The same, and that the camera is not below the ground or inside an object: nothing may be seen
/// from behind straight above it. "camera is 3.2 m below the terrain"
void check_observer(const Observer& observer, const FacetSet& facets, const RayScene& scene);

/// The observer turned so that its axis goes through `target` (east, north, up [m]).
Observer looking_at(Observer observer, const Eigen::Vector3d& target);

/// Directions of an observer's pixels, worked out once.
struct PixelRays {
    Eigen::Vector3d corner;  // towards column 0, row 0; not of unit length
    Eigen::Vector3d column;  // added for each column to the right
    Eigen::Vector3d row;     // added for each row downward
    bool flat = true;        // directions are linear in the place before normalisation

    /// Unit vector towards a place in the picture, in pixels from its upper left corner.
    Eigen::Vector3d towards(double at_column, double at_row) const;
};
PixelRays pixel_rays(const Observer& observer);

}  // namespace diurna
