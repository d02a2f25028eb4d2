#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "render/view/observer.hpp"

namespace diurna {

/// Directions of an observer's pixels by its projection, worked out once.
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
    // And of one that turns [rad].
    Eigen::Vector3d row_turn = Eigen::Vector3d::Zero(), exposure_turn = Eigen::Vector3d::Zero();
    bool turns = false;

    /// Unit vector towards a place in the picture, in pixels from its upper left corner, `when` of
    /// the row's exposure has gone by, 0 to 1.
    Eigen::Vector3d towards(double at_column, double at_row, double when = 0.5) const;
    /// The same without the turn.
    Eigen::Vector3d still(double at_column, double at_row) const;
    /// A direction as the camera has turned it since the middle of the first row's exposure.
    Eigen::Vector3d turned(const Eigen::Vector3d& direction, double at_row, double when) const;
    /// The way back, at the middle of a row's exposure.
    Eigen::Vector3d turned_back(const Eigen::Vector3d& direction, double at_row) const;
    /// Where the ray through that place begins, seen from the observer's position [m], `when` of
    /// the row's exposure has gone by, 0 to 1: zero but for the orthographic projection and cameras
    /// that move.
    Eigen::Vector3d start(double at_column, double at_row, double when = 0.5) const;
};
PixelRays pixel_rays(const Observer& observer);

/// Angle [rad] between neighbouring samples of a pixel, at the middle of the picture; orthographic:
/// distance [m].
double sample_angle(const Observer& observer, int samples);

/// What of the exposure has gone by at a pixel's sample, 0 to 1: even over its samples, whatever
/// their number and their places (golden ratio). `offset` is the pixel's own, 0 to 1.
double exposed(std::size_t sample, double offset);

}  // namespace diurna
