#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// How directions become places in the picture; θ is the angle from the optical axis, r the
/// distance from the picture's middle.
enum class Projection {
    pinhole,       // r = f tan θ
    equidistant,   // r = f θ: a fisheye in which angles are true
    equisolid,     // r = 2 f sin(θ/2): a fisheye whose pixels have equal solid angles
    panorama,      // columns are azimuths, rows elevations, in equal steps; the axis' elevation and
                   // roll turn it as a whole
    orthographic,  // parallel rays from a plane through the position, across the axis
};

/// A camera: pose, projection, field of view, size of its picture, and how it moves meanwhile.
///
/// Pixels are square. Column 0, row 0 is the upper left one; its centre lies at (0.5, 0.5). The
/// corners of a fisheye's picture lie outside its circle and go on by the same law, behind the
/// camera at last.
struct Observer {
    std::string name = "observer";
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // east, north, up [m]
    double azimuth_deg = 0.0;          // of the optical axis, clockwise from true north
    double elevation_deg = 0.0;        // above the horizontal, −90 to 90
    double roll_deg = 0.0;             // the camera turned clockwise about its axis
    double horizontal_fov_deg = 20.0;  // from the left edge to the right, 0.001 to 170 (pinhole),
                                       // to 360 (fisheyes: to 180 as a rule, panorama)
    int width = 640, height = 512;     // [pixels]
    Projection projection = Projection::pinhole;
    double picture_width = 0.0;  // [m] orthographic: from the left edge to the right

    // While a picture is taken the scene stands still and the camera goes straight on without
    // turning. The position is that at the middle of the first row's exposure.
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // east, north, up [m s⁻¹]
    double row_time = 0.0;  // [s] from a row's exposure to the next one's; 0: all at once
    double exposure = 0.0;  // [s] of each row
    bool moves() const { return !velocity.isZero() && (row_time > 0.0 || exposure > 0.0); }
};

/// The field of view [deg] of a focal plane: width · pitch behind a lens of a focal length.
double field_of_view_deg(int width, double pitch_um, double focal_length_mm);

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

    // Of the other projections.
    Projection projection = Projection::pinhole;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitY(), right = Eigen::Vector3d::UnitX(),
                    down = -Eigen::Vector3d::UnitZ();  // unit, at right angles
    double middle_column = 0.0, middle_row = 0.0;      // of the picture [pixels]
    double per_pixel = 1.0;  // [rad], of r/f (fisheyes) or of angle; [m] orthographic

    // Of a camera that moves [m]: its way from a row to the next, and during an exposure.
    Eigen::Vector3d row_way = Eigen::Vector3d::Zero(), exposure_way = Eigen::Vector3d::Zero();

    /// Unit vector towards a place in the picture, in pixels from its upper left corner.
    Eigen::Vector3d towards(double at_column, double at_row) const;
    /// Where the ray through that place begins, seen from the observer's position [m], `when` of
    /// the row's exposure has gone by, 0 to 1: zero but for the orthographic projection and cameras
    /// that move.
    Eigen::Vector3d start(double at_column, double at_row, double when = 0.5) const;
};
PixelRays pixel_rays(const Observer& observer);

/// What of the exposure has gone by at a pixel's sample, 0 to 1: even over its samples, whatever
/// their number and their places (golden ratio). `offset` is the pixel's own, 0 to 1.
double exposed(std::size_t sample, double offset);

}  // namespace diurna
