#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <span>

#include "materials/base/unfinished.hpp"

namespace diurna {

/// An MP4 that ffmpeg makes of pictures as they come. It stands under its name once finish() has
/// returned; before that, or if the program is interrupted, there is nothing of it, and what was
/// there stays.
class FfmpegMovie {
 public:
    /// Starts ffmpeg. Throws std::runtime_error where there is none on the PATH.
    FfmpegMovie(const std::filesystem::path& file, double pictures_per_second);
    ~FfmpegMovie();
    FfmpegMovie(const FfmpegMovie&) = delete;
    FfmpegMovie& operator=(const FfmpegMovie&) = delete;

    /// One picture as PNG, all of the same size. Throws std::runtime_error where ffmpeg takes no
    /// more.
    void add(std::span<const std::byte> png);
    void finish();

 private:
    UnfinishedFile part_;
    pid_t child_ = -1;
    int pipe_ = -1;
};

}  // namespace diurna
