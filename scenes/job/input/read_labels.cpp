#include "scenes/job/input/read_labels.hpp"

namespace diurna {

LabelsInput read_labels(const Section& section) {
    LabelsInput labels;
    labels.bits = section.integer_or(
        "bits",
        "bits of the grey pictures in images/: 8 spans percentile 1 to percentile 99 of the "
        "surfaces in each picture (values outside have count 0 or 255); 16 has 0.01 K per count "
        "(below 3 µm: radiance in steps of 1, 2 or 5 times a power of ten), which viewers and "
        "programs that read only the upper 8 bits show nearly black; annotations.json has each "
        "picture's scale",
        labels.bits, {8, 16});
    if (labels.bits != 8 && labels.bits != 16) section.mistake("bits", "expected 8 or 16");
    labels.format =
        section.choice_or("format", "file format of the grey pictures in images/", GreyFormat::png,
                          {{"png", GreyFormat::png}, {"tiff", GreyFormat::tiff}});
    labels.validation_share =
        section.number_or("validation_share",
                          "share of the instants, drawn by scene.seed, whose pictures are for "
                          "validation; the others are for training",
                          labels.validation_share, {0.0, 1.0});
    return labels;
}

}  // namespace diurna
