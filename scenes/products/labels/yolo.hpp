#pragma once

#include <string>
#include <vector>

#include "scenes/products/labels/label.hpp"

namespace diurna {

/// A picture's labels for YOLO: "CLASS X Y WIDTH HEIGHT" a line, classes from 0, middle and size of
/// the visible box relative to the picture. Without groups.
std::string yolo_text(const LabelBook& book, const LabelledPicture& picture);

/// The description of a run's folder for Ultralytics' YOLO: classes and the lists of pictures.
std::string yolo_data(const LabelBook& book);

}  // namespace diurna
