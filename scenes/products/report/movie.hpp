#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "render/picture/colour_scale.hpp"

namespace diurna {

struct MovieOptions {
    std::filesystem::path folder;  // of a run
    std::string observer, band;    // "": the only one
    std::filesystem::path file;    // .mp4 or .gif; "": OBSERVER_BAND.mp4 in folder
    double pictures_per_second = 10.0;
    bool display = false;  // the pictures on an instrument's display, as the run wrote them
};

struct MovieReport {
    std::filesystem::path file;
    std::size_t pictures = 0;
    ColourScale scale{};  // common to all of them; of a display 0 to 255
    std::string plane, unit;
};

/// The pictures of an observer in a band in sequence as MP4 or GIF, all on one scale of colours,
/// the widest of theirs; those of a display unchanged. Throws InputError if the folder has no such
/// pictures, or several observers or bands and none is given; if a GIF is to be faster than viewers
/// can show; std::runtime_error without ffmpeg.
MovieReport write_movie(const MovieOptions& options);

}  // namespace diurna
