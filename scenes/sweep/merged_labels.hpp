#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/sweep/variants.hpp"

namespace diurna {

/// What became of the labels of all variants.
struct MergedLabels {
    std::vector<std::string> files{};  // relative to the sweep's folder
    std::vector<std::string> notes{};
};

/// One COCO data set of all variants' (scenes/labels/coco.hpp), in the same three files, with the
/// lists and data.yaml for YOLO. Ids run through; names of pictures go from the sweep's folder;
/// `images` say their `variant`. Training and validation are drawn anew over all variants.
///
/// - out: where all variants are done
MergedLabels merge_labels(const Sweep& sweep, const std::filesystem::path& out);

}  // namespace diurna
