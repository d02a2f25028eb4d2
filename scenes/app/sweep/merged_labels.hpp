#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/app/sweep/variants.hpp"

namespace diurna {

/// Merged labels of all variants.
struct MergedLabels {
    std::vector<std::string> files{};  // relative to the sweep's folder
    std::vector<std::string> notes{};
};

/// One COCO data set of all variants' (scenes/products/labels/coco.hpp), in the same three files,
/// with the lists and data.yaml for YOLO. Ids are consecutive; names of pictures are relative to
/// the sweep's folder; `images` have their `variant`. Training and validation are drawn again over
/// all variants.
///
/// - out: folder with all finished variants
MergedLabels merge_labels(const Sweep& sweep, const std::filesystem::path& out);

}  // namespace diurna
