#pragma once

#include "materials/base/section.hpp"
#include "render/picture/grey_picture.hpp"

namespace diurna {

/// Labels of pictures, as training data.
struct LabelsInput {
    int bits = 8;  // of the plain grey pictures
    GreyFormat format = GreyFormat::png;
    double validation_share = 0.2;  // of the instants
};

/// The section [labels].
LabelsInput read_labels(const Section& section);

}  // namespace diurna
