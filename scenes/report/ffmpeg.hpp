#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "materials/base/child_process.hpp"
#include "materials/base/unfinished.hpp"

namespace diurna {

/// What ffmpeg can make of pictures here.
enum class MovieKind { mp4, gif };

/// A movie that ffmpeg makes of pictures as they come: MP4 (H.264), or a GIF that repeats, of a
/// palette chosen for all its pictures. It stands under its name once finish() has
/// returned; before that, or if the program is interrupted, there is nothing of it, and what was
/// there stays.
class FfmpegMovie {
 public:
    /// Starts ffmpeg. Throws std::runtime_error where there is none on the PATH.
    FfmpegMovie(const std::filesystem::path& file, MovieKind kind, double pictures_per_second);
    ~FfmpegMovie();
    FfmpegMovie(const FfmpegMovie&) = delete;
    FfmpegMovie& operator=(const FfmpegMovie&) = delete;

    /// One picture as PNG, all of the same size. Throws std::runtime_error where ffmpeg takes no
    /// more.
    void add(std::span<const std::byte> png);
    void finish();

 private:
    UnfinishedFile part_;
    std::unique_ptr<ChildProcess> child_;
    int pipe_ = -1;
};

}  // namespace diurna
