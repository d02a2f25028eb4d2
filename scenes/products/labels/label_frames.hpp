#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Writes the labels of all frames of a job, already in `out`, from their truth
/// planes:
///
///     annotations.json, annotations_train.json, annotations_validation.json   COCO (coco.hpp)
///     labels/PICTURE.txt, data.yaml, train.txt, validation.txt   YOLO; the lists name pictures
///     kitti/PICTURE.txt, kitti/calib/PICTURE.txt                 KITTI
///     classes.txt                                                a class a line
///
/// Returns their names.
std::vector<std::string> label_frames(const Prepared& prepared, const std::filesystem::path& out);

}  // namespace diurna
