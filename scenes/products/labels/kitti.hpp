#pragma once

#include <string>

#include "render/view/observer.hpp"
#include "scenes/products/labels/label.hpp"

namespace diurna {

/// A picture's labels in KITTI's fifteen columns (Geiger et al. 2012, object development kit):
///
///     type truncated occluded alpha left top right bottom height width length x y z rotation_y
///
/// type: the class with '_' for blanks, a group is DontCare; truncated: share, 0 to 1; occluded: 0
/// up to a twentieth hidden, 1 up to half, 2 more; left ... bottom [pixels]: the visible box, its
/// last column and row; sizes and position of the middle of the bottom [m] in the camera's frame
/// rotated to level (x to the right, y straight down, z ahead, all about the eye); rotation_y about
/// that y, 0 if the front faces along x; alpha = rotation_y − atan2(x, z). kitti_calibration()
/// projects it into the picture for any inclination and roll of the camera.
std::string kitti_text(const LabelBook& book, const LabelledPicture& picture,
                       const Observer& observer);

/// The calibration for it, in KITTI's lines: P0 to P3 all convert a point of the level frame to
/// column × depth, row × depth and depth, 0 at the middle of the upper left pixel; R0_rect is
/// unity; Tr_velo_to_cam that of a level frame (ahead, left, up) about the eye. Empty for other
/// cameras than pinholes.
std::string kitti_calibration(const Observer& observer);

}  // namespace diurna
