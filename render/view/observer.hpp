#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <string>

#include "render/view/projection.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// A camera: pose, projection, field of view, size of its picture, and motion during exposure.
///
/// Pixels are square. Column 0, row 0 is the upper left one; its centre is at (0.5, 0.5). The
/// corners of a fisheye's picture are outside its circle and follow the same law, eventually behind
/// the camera.
struct Observer {
    std::string name = "observer";
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // east, north, up [m]
    double azimuth_deg = 0.0;          // of the optical axis, clockwise from true north
    double elevation_deg = 0.0;        // above the horizontal, −90 to 90
    double roll_deg = 0.0;             // clockwise rotation of the camera about its axis
    double horizontal_fov_deg = 20.0;  // from the left edge to the right, 0.001 to 170 (pinhole),
                                       // to 360 (fisheyes: to 180 as a rule, panorama)
    int width = 640, height = 512;     // [pixels]
    Projection projection = Projection::pinhole;
    double picture_width = 0.0;  // [m] orthographic: from the left edge to the right

    // While a picture is taken the camera, like moving objects of the scene (FacetMotion), moves
    // straight and rotates at a constant rate. Position and angles are those at the middle of the
    // first row's exposure.
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // east, north, up [m s⁻¹]
    Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // about east, north, up [rad s⁻¹]
    double row_time = 0.0;  // [s] from a row's exposure to the next one's; 0: all at once
    double exposure = 0.0;  // [s] of each row
    bool moves() const { return (!velocity.isZero() || turns()) && takes_time(); }
    bool turns() const { return !turning.isZero() && takes_time(); }
    bool takes_time() const { return row_time > 0.0 || exposure > 0.0; }
    /// [s] from the instant of the picture to the end of its last exposure: ray times 0 and 1 are
    /// this much before and after the instant.
    double reach() const { return 0.5 * exposure + row_time * (height - 1); }
};

/// The field of view [deg] of a focal plane: width · pitch behind a lens of a focal length.
double field_of_view_deg(int width, double pitch_um, double focal_length_mm);

/// Throws InputError if a value is not finite or out of its range.
void check_observer(const Observer& observer);

/// The same, and that the camera is not below the ground or inside an object: vertically above it
/// no facet may be visible from behind. "camera is 3.2 m below the terrain"
///
/// - ground_facets: the first ones, of any object; if 0, object 0 is the ground
/// - names: (ObjectId) for the message
void check_observer(const Observer& observer, const FacetSet& facets, const RayScene& scene,
                    std::size_t ground_facets = 0, std::span<const std::string> names = {});

/// Rotates the camera's right, forward, up to east, north, up.
Eigen::Quaterniond attitude_of(const Observer& observer);
/// The observer with that attitude. If it looks straight down or up, it has no roll: its azimuth is
/// the direction of the picture's upper edge, or its lower.
Observer turned_to(Observer observer, const Eigen::Quaterniond& attitude);

/// The observer rotated so that its axis passes through `target` (east, north, up [m]).
Observer looking_at(Observer observer, const Eigen::Vector3d& target);

}  // namespace diurna
