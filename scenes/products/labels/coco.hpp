#pragma once

#include <string>
#include <vector>

#include "scenes/products/labels/label.hpp"

namespace diurna {

/// A COCO data set of pictures (cocodataset.org, "object detection"), as JSON on one line.
///
/// - categories: the classes, ids from 1
/// - images: the plain grey pictures, to whose pixels the boxes refer; with `planes` (the EXR),
///   observer, band, bits, the value of a count, the counts to display as black and white and the
///   number of pixels outside (`scale`), and camera, sun and air
/// - annotations: one for each visible object. `segmentation` is an uncompressed run-length mask
///   ({"size": [height, width], "counts": [...]}, down the columns), `bbox` [left, top, width,
///   height] and `area` are the mask's; `iscrowd` is 1 only if several things share one name
///   (the buildings of a [[shapes]]). In addition to COCO: `instance` (object_id, name),
///   `amodal_bbox`, `occlusion`, `truncation`, `pixels_on_target`, `range_m`, `aspect`, `contrast`.
/// - info: program and version, and how to read and display the grey pictures (`grey_pictures`)
std::string coco_json(const LabelBook& book, const std::vector<const LabelledPicture*>& pictures);

/// How to read and display the grey pictures, for 8 and 16 bits.
std::string grey_picture_words();

}  // namespace diurna
