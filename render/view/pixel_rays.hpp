#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "render/view/observer.hpp"

namespace diurna {

/// Directions of an observer's pixels by its projection, computed once.
struct PixelRays {
    Eigen::Vector3d corner;  // towards column 0, row 0; not of unit length
    Eigen::Vector3d column;  // added for each column to the right
    Eigen::Vector3d row;     // added for each row downward
    bool flat = true;        // directions are linear in the position before normalisation

    // For the other projections.
    Projection projection = Projection::pinhole;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitY(), right = Eigen::Vector3d::UnitX(),
                    down = -Eigen::Vector3d::UnitZ();  // unit, at right angles
    double middle_column = 0.0, middle_row = 0.0;      // of the picture [pixels]
    double per_pixel = 1.0;  // [rad], of r/f (fisheyes) or of angle; [m] orthographic

    // For a moving camera [m]: displacement from a row to the next, and during an exposure.
    Eigen::Vector3d row_way = Eigen::Vector3d::Zero(), exposure_way = Eigen::Vector3d::Zero();
    // For a rotating one [rad].
    Eigen::Vector3d row_turn = Eigen::Vector3d::Zero(), exposure_turn = Eigen::Vector3d::Zero();
    bool turns = false;

    /// Unit vector towards a position in the picture, in pixels from its upper left corner, after a
    /// fraction `when` of the row's exposure, 0 to 1.
    Eigen::Vector3d towards(double at_column, double at_row, double when = 0.5) const;
    /// The same without rotation.
    Eigen::Vector3d still(double at_column, double at_row) const;
    /// A direction after the camera's rotation since the middle of the first row's exposure.
    Eigen::Vector3d turned(const Eigen::Vector3d& direction, double at_row, double when) const;
    /// The inverse, at the middle of a row's exposure.
    Eigen::Vector3d turned_back(const Eigen::Vector3d& direction, double at_row) const;
    /// Origin of the ray through that position, relative to the observer's position [m], after a
    /// fraction `when` of the row's exposure, 0 to 1: zero except for the orthographic projection
    /// and moving cameras.
    Eigen::Vector3d start(double at_column, double at_row, double when = 0.5) const;
};
PixelRays pixel_rays(const Observer& observer);

/// Angle [rad] between neighbouring samples of a pixel, at the middle of the picture; orthographic:
/// distance [m].
double sample_angle(const Observer& observer, int samples);

/// Fraction of the exposure at a pixel's sample, 0 to 1: evenly distributed over its samples for
/// any number of them (golden ratio). `offset` is the pixel's own, 0 to 1.
double exposed(std::size_t sample, double offset);

}  // namespace diurna
