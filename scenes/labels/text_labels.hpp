#pragma once

#include <string>
#include <vector>

#include "scenes/labels/label.hpp"
#include "scenes/plan/prepared.hpp"

namespace diurna {

/// A picture's labels for YOLO: "CLASS X Y WIDTH HEIGHT" a line, classes from 0, middle and size of
/// the box seen as shares of the picture. Without groups.
std::string yolo_text(const LabelBook& book, const LabelledPicture& picture);

/// The file that tells Ultralytics' YOLO of a run's folder: classes and the lists of pictures.
std::string yolo_data(const LabelBook& book);

/// A picture's labels in KITTI's fifteen columns (Geiger et al. 2012, object development kit):
///
///     type truncated occluded alpha left top right bottom height width length x y z rotation_y
///
/// type: the class with '_' for blanks, a group is DontCare; truncated: share, 0 to 1; occluded: 0
/// up to a twentieth hidden, 1 up to half, 2 more; left ... bottom [pixels]: the box seen, its last
/// column and row; sizes and place of the middle of the bottom [m] in the camera's frame (x right,
/// y down, z along its axis); rotation_y about the camera's y, 0 where the front faces its x; alpha
/// = rotation_y − atan2(x, z). A camera that looks down or is rolled leaves them what they are in
/// its frame: the box's other two angles are lost.
std::string kitti_text(const LabelBook& book, const LabelledPicture& picture,
                       const Observer& observer);

}  // namespace diurna
