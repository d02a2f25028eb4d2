#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "materials/base/child_process.hpp"
#include "materials/base/unfinished.hpp"

namespace diurna {

/// Formats of movies.
enum class MovieKind { mp4, gif };

/// A movie made by ffmpeg from pictures as they arrive: MP4 (H.264), or a looping GIF with a
/// palette chosen for all its pictures. It gets its name when finish() has returned; before
/// that, or if the program is interrupted, no file is created and an existing one is
/// unchanged.
class FfmpegMovie {
 public:
    /// Starts ffmpeg. Throws std::runtime_error if it is not on the PATH.
    FfmpegMovie(const std::filesystem::path& file, MovieKind kind, double pictures_per_second);
    ~FfmpegMovie();
    FfmpegMovie(const FfmpegMovie&) = delete;
    FfmpegMovie& operator=(const FfmpegMovie&) = delete;

    /// Adds one picture as PNG, all of the same size. Throws std::runtime_error if ffmpeg has
    /// stopped reading.
    void add(std::span<const std::byte> png);
    void finish();

 private:
    UnfinishedFile part_;
    std::unique_ptr<ChildProcess> child_;
    int pipe_ = -1;
};

}  // namespace diurna
