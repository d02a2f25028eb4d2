#include "scenes/report/ffmpeg.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

extern char** environ;

namespace diurna {

namespace {

/// Reads what comes through `input`; in a process group of its own, which ends with the program.
pid_t start(std::vector<std::string> words, int input) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = -1;
    const int code = posix_spawnp(&child, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (code == 0) return child;
    if (code == ENOENT) {
        throw std::runtime_error("ffmpeg is not on the PATH, a movie needs it (Debian: ffmpeg)");
    }
    throw std::runtime_error(fmt::format("ffmpeg cannot be started: {}", std::strerror(code)));
}

/// Between the pictures that come and the file's name. The pictures have 250 colours; a GIF's
/// palette is of all of them together, and no dots stand for colours in between.
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
    set_child_group(child_);
}

FfmpegMovie::~FfmpegMovie() {
    if (pipe_ >= 0) ::close(pipe_);
    if (child_ > 0) {
        ::kill(-child_, SIGKILL);
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    set_child_group(0);
}

void FfmpegMovie::add(std::span<const std::byte> png) {
    while (!png.empty()) {
        const ssize_t written = ::write(pipe_, png.data(), png.size());
        if (written >= 0) {
            png = png.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            throw std::runtime_error("ffmpeg has ended before the pictures: no movie was written");
        }
    }
}

void FfmpegMovie::finish() {
    ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    set_child_group(0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error("ffmpeg has failed: no movie was written");
    }
    part_.finish();
}

}  // namespace diurna
