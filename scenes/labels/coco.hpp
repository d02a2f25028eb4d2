#pragma once

#include <string>
#include <vector>

#include "scenes/labels/label.hpp"

namespace diurna {

/// A COCO data set of pictures (cocodataset.org, "object detection"), as JSON on one line.
///
/// - categories: the classes, ids from 1
/// - images: the plain grey pictures, whose pixels are those of the boxes; with `planes` (the EXR),
///   observer, band, bits, the value of a count, the counts to display as black and white and how
///   many pixels lie beyond (`scale`), and camera, sun and air
/// - annotations: one for each object seen. `segmentation` is an uncompressed run-length mask
///   ({"size": [height, width], "counts": [...]}, down the columns), `bbox` [left, top, width,
///   height] and `area` are the mask's; `iscrowd` is 1 only where several things share one name
///   (the buildings of a [[shapes]]). Beyond COCO's: `instance` (object_id, name), `amodal_bbox`,
///   `occlusion`, `truncation`, `pixels_on_target`, `range_m`, `aspect`, `contrast`.
/// - info: by what it was made, and how to read and to view the grey pictures (`grey_pictures`)
std::string coco_json(const LabelBook& book, const std::vector<const LabelledPicture*>& pictures);

/// How to read and to view the grey pictures, of either depth.
std::string grey_picture_words();

}  // namespace diurna
