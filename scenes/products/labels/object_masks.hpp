#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"

namespace diurna {

/// Pixels of one object in a picture.
struct ObjectMask {
    int object;                    // ObjectId
    int left, top, width, height;  // [pixels] of the smallest box around it
    std::size_t pixels;
    /// COCO's run lengths: down the columns, left to right, first the pixels outside.
    std::vector<std::uint32_t> runs;
};

/// The masks of all objects except the ground (0) and the sky (−1), by ObjectId, from the truth
/// plane `object` and, if the frame has it, `object_behind.BAND`: a pixel whose centre sees an
/// object through a net or a pane is in the masks of both.
std::vector<ObjectMask> object_masks(const Frame& frame, const std::string& band);

/// (row, column) 1 in the mask.
std::vector<std::uint8_t> pixels_of(const ObjectMask& mask, int width, int height);

}  // namespace diurna
