#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "tests/support/passed_over.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// `diurna movie` with a program in place of ffmpeg that keeps what it is given.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

/// With the folder `bin` before the PATH, or as all of it.
Ran movie(const fs::path& bin, bool alone, const std::string& arguments,
          const std::string& before = "") {
    const std::string command = fmt::format("PATH=\"{}{}\" {} '" DIURNA_BINARY "' movie {} 2>&1",
                                            bin.string(), alone ? "" : ":$PATH", before, arguments);
    return ran(command);
}

/// A run's folder with three pictures of a cold half and a warm one.
struct RunFolder {
    ScratchFolder folder{"movie"};
    fs::path bin = folder.path / "bin", run = folder.path / "run";

    RunFolder() {
        fs::create_directories(bin);
        fs::create_directories(run / "frames");
        const std::vector<float> warm = {300.0f, 320.0f, 300.0f};
        for (int i = 0; i < 3; ++i) {
            Frame frame;
            frame.width = 64;
            frame.height = 48;
            std::vector<float> kelvin(64 * 48, 280.0f);
            std::fill(kelvin.begin() + 64 * 24, kelvin.end(), warm[std::size_t(i)]);
            frame.planes = {{"apparent_temperature.8-12", "K", kelvin},
                            {"temperature", "K", kelvin}};
            write_exr(run / "frames" / fmt::format("east_8-12_2026071{}T000000Z.exr", i), frame);
        }
    }
    /// A shell script by the name of ffmpeg; $last is the file that it is to write.
    void ffmpeg(const std::string& does) const {
        write_text(bin / "ffmpeg", fmt::format("#!/bin/sh\nfor last; do :; done\n{}\n", does));
        fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    }
    std::string argument() const { return fmt::format("'{}'", run.string()); }
    fs::path made() const { return run / "east_8-12.mp4"; }
    /// Neither the movie nor anything unfinished.
    bool nothing() const {
        for (const auto& entry : fs::directory_iterator(run)) {
            if (entry.path() != run / "frames") return false;
        }
        return true;
    }
};

}  // namespace

TEST_CASE("a movie's pictures come in order on one scale", "[scenes][movie]") {
    const RunFolder folder;
    folder.ffmpeg("cat > \"$last\"");
    const Ran ran = movie(folder.bin, false, folder.argument());
    INFO(ran.out);
    REQUIRE(ran.code == 0);
    CHECK(ran.out.find("3 pictures, apparent_temperature.8-12 from 6 to 47 °C") !=
          std::string::npos);
    const std::string signature = "\x89PNG\r\n\x1a\n", all = read_text(folder.made());
    std::vector<std::string> picture;
    for (std::size_t at = all.find(signature); at != std::string::npos;) {
        const std::size_t next = all.find(signature, at + 1);
        picture.push_back(all.substr(at, next - at));
        at = next;
    }
    REQUIRE(picture.size() == 3);
    // On a scale of its own each would be as dark below and as light above as the others.
    CHECK((picture[0] == picture[2]));
    CHECK((picture[0] != picture[1]));
}

TEST_CASE("a movie of a display has its pictures unchanged and in order", "[scenes][movie]") {
    const RunFolder folder;
    folder.ffmpeg("cat > \"$last\"");
    const Ran none = movie(folder.bin, false, folder.argument() + " --display");
    CHECK(none.code == 2);
    CHECK(none.out.find("found no folder instrument") != std::string::npos);
    fs::create_directories(folder.run / "instrument");
    for (const char* day : {"12", "10", "11"}) {
        const std::string base = fmt::format("east_8-12_202607{}T000000Z", day);
        write_text(folder.run / "instrument" / (base + "_display.png"), fmt::format("[{}]", day));
        write_text(folder.run / "instrument" / (base + ".png"), "counts");
    }
    const Ran ran = movie(folder.bin, false, folder.argument() + " --display");
    INFO(ran.out);
    REQUIRE(ran.code == 0);
    CHECK(ran.out.find("3 pictures, display from 0 to 255 grey levels") != std::string::npos);
    CHECK(read_text(folder.run / "east_8-12_display.mp4") == "[10][11][12]");
}

TEST_CASE("without ffmpeg, or where it fails, there is an error and no movie", "[scenes][movie]") {
    const RunFolder folder;
    Ran ran = movie(folder.bin, true, folder.argument());
    CHECK(ran.code == 1);
    CHECK(
        ran.out ==
        "diurna: ffmpeg is not on the PATH; install it to make movies (Debian package: ffmpeg)\n");
    CHECK(folder.nothing());
    folder.ffmpeg("cat > \"$last\"; exit 3");
    CHECK(movie(folder.bin, false, folder.argument()).code == 1);
    CHECK(folder.nothing());
    // Interrupted while it works, the other program does not work on.
    folder.ffmpeg("cat > \"$last\"; sleep 3; echo on > '" + folder.folder.path.string() +
                  "/worked_on'");
    for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}, {"HUP", 129}}) {
        CHECK(movie(folder.bin, false, folder.argument(),
                    fmt::format("timeout --preserve-status -s {} 1", signal))
                  .code == code);
        CHECK(folder.nothing());
    }
    ::sleep(3);
    CHECK(!fs::exists(folder.folder.path / "worked_on"));
    // Under nohup a hangup is none.
    const Ran goes_on =
        movie(folder.bin, false, folder.argument(), "timeout --foreground -s HUP 1 nohup");
    CHECK(goes_on.code == 124);  // timeout's own word for having sent it
    CHECK(fs::exists(folder.made()));
}

// GIF89a: its signature, and by the Graphic Control Extension (23) hundredths of a second from each
// picture to the next.
TEST_CASE("a movie whose name ends in .gif is one", "[scenes][movie]") {
    const RunFolder folder;
    const fs::path made = folder.run / "day.gif";
    const std::string out = fmt::format(" --out '{}'", made.string());
    folder.ffmpeg("echo \"$@\" > '" + folder.folder.path.string() + "/asked'; cat > \"$last\"");
    CHECK(movie(folder.bin, false, folder.argument() + out).code == 0);
    CHECK(read_text(folder.folder.path / "asked").find("palettegen") != std::string::npos);
    fs::remove(made);
    CHECK(movie(folder.bin, false, folder.argument() + out + " --fps 60").code == 2);
    Ran ran = movie(folder.bin, false, folder.argument() + " --out day.webm");
    CHECK(ran.code == 2);
    CHECK(ran.out.find("expected a name that ends in .mp4 or .gif") != std::string::npos);
    CHECK(folder.nothing());
    fs::remove(folder.bin / "ffmpeg");
    if (::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        pass_over("no ffmpeg");
        return;
    }
    REQUIRE(movie(folder.bin, false, folder.argument() + out + " --fps 4").code == 0);
    const std::string gif = read_text(made);
    REQUIRE(gif.size() > 13);
    CHECK(gif.starts_with("GIF89a"));
    const auto two = [&](std::size_t at) {
        return std::uint8_t(gif[at]) + 256 * std::uint8_t(gif[at + 1]);
    };
    CHECK(two(6) == 64);
    CHECK(two(8) == 48);
    const std::string control("\x21\xf9\x04", 3);
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = gif.find(control, at)) != std::string::npos; at += 8) {
        ++pictures;
        CHECK(two(at + 4) == 25);
    }
    CHECK(pictures == 3);
    // The same pictures, the same bytes.
    fs::remove(made);
    REQUIRE(movie(folder.bin, false, folder.argument() + out + " --fps 4").code == 0);
    CHECK(read_text(made) == gif);
}

TEST_CASE("a movie of several observers requires a choice", "[scenes][movie]") {
    const RunFolder folder;
    folder.ffmpeg("cat > \"$last\"");
    fs::copy(folder.run / "frames/east_8-12_20260710T000000Z.exr",
             folder.run / "frames/west_8-12_20260710T000000Z.exr");
    const Ran ran = movie(folder.bin, false, folder.argument());
    CHECK(ran.code == 2);
    CHECK(ran.out.find("--observer east --band 8-12; --observer west --band 8-12") !=
          std::string::npos);
    CHECK(movie(folder.bin, false, folder.argument() + " --observer east").code == 0);
    CHECK(movie(folder.bin, false, fmt::format("'{}'", folder.bin.string())).code == 2);
}
