#include "scenes/products/report/ffmpeg.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace diurna {

namespace {

/// Reads what comes through `input`.
std::unique_ptr<ChildProcess> start(std::vector<std::string> words, int input) {
    try {
        return std::make_unique<ChildProcess>(ChildStart{
            .words = std::move(words), .on_path = true, .input = input, .prints_errors = true});
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::no_such_file_or_directory) {
            throw std::runtime_error(
                "ffmpeg is not on the PATH; install it to make movies (Debian package: ffmpeg)");
        }
        throw std::runtime_error("ffmpeg cannot be started: " + error.code().message());
    }
}

/// Between the pictures that come and the file's name. The pictures have 250 colours; a GIF's
/// palette is of all of them together, and no dots represent colours in between.
std::vector<std::string> output_words(MovieKind kind) {
    if (kind == MovieKind::gif) {
        return {"-filter_complex",
                "[0:v]split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none",
                "-loop",
                "0",
                "-f",
                "gif"};
    }
    return {"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
            "-c:v",      "libx264",
            "-crf",      "16",
            "-pix_fmt",  "yuv420p",
            "-movflags", "+faststart",
            "-f",        "mp4"};
}

}  // namespace

FfmpegMovie::FfmpegMovie(const std::filesystem::path& file, MovieKind kind,
                         double pictures_per_second)
    : part_(file) {
    std::signal(SIGPIPE, SIG_IGN);  // a pipe that nobody reads is an error of write()
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    pipe_ = ends[1];
    std::vector<std::string> words{"ffmpeg",
                                   "-hide_banner",
                                   "-loglevel",
                                   "error",
                                   "-y",
                                   "-f",
                                   "image2pipe",
                                   "-c:v",
                                   "png",
                                   "-framerate",
                                   fmt::format("{:g}", pictures_per_second),
                                   "-i",
                                   "-"};
    const std::vector<std::string> wanted = output_words(kind);
    words.insert(words.end(), wanted.begin(), wanted.end());
    words.push_back(std::filesystem::absolute(part_.path()).string());
    try {
        child_ = start(std::move(words), ends[0]);
    } catch (...) {
        ::close(ends[0]);
        ::close(ends[1]);
        throw;
    }
    ::close(ends[0]);
}

FfmpegMovie::~FfmpegMovie() {
    if (pipe_ >= 0) ::close(pipe_);
}

void FfmpegMovie::add(std::span<const std::byte> png) {
    while (!png.empty()) {
        const ssize_t written = ::write(pipe_, png.data(), png.size());
        if (written >= 0) {
            png = png.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            throw std::runtime_error("ffmpeg ended before the last picture: no movie was written");
        }
    }
}

void FfmpegMovie::finish() {
    ::close(pipe_);
    pipe_ = -1;
    const int status = child_->wait();
    child_.reset();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error("ffmpeg failed: no movie was written");
    }
    part_.finish();
}

}  // namespace diurna
