#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"
#include "scenes/plan/prepared.hpp"

namespace diurna {

/// Where one object is seen in a picture, from the truth plane `object`.
struct ObjectMask {
    int object;                    // ObjectId
    int left, top, width, height;  // [pixels] of the smallest box around it
    std::size_t pixels;
    /// COCO's run lengths: down the columns, left to right, first the pixels outside.
    std::vector<std::uint32_t> runs;
};

/// The masks of all objects but the ground (0) and the sky (−1), by ObjectId.
std::vector<ObjectMask> object_masks(const Frame& frame);

/// One picture of a series and the masks of what is seen in it.
struct Annotated {
    std::string file;  // relative to the run's folder
    Instant instant;
    std::string observer;
    int width, height;
    const std::vector<ObjectMask>* masks;
};

/// Writes annotations.json in the COCO format: images, one category an object, and for every image
/// and object seen in it a box, an area and an uncompressed run-length mask.
void write_annotations(const std::filesystem::path& folder, const std::vector<Annotated>& images,
                       const std::vector<std::string>& object_names);

/// Writes annotations.json for all frames of a job, which lie in `out` already. Nothing moves, so
/// one frame of an observer tells where the objects are in all of them.
void annotate_frames(const Prepared& prepared, const std::filesystem::path& out);

}  // namespace diurna
