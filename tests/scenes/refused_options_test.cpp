#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// What the command line has to refuse before anything is written: numbers that are none, empty
// texts, results that would go over what they are made of.

namespace {

namespace fs = std::filesystem;

Ran in_folder(const fs::path& folder, const std::string& arguments) {
    return ran("cd '" + folder.string() + "' && '" DIURNA_BINARY "' " + arguments + " 2>&1");
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder),
                                                  fs::recursive_directory_iterator{}));
}

}  // namespace

TEST_CASE("a number that is not finite or out of range is refused in one line, nothing written",
          "[command_line][options]") {
    const ScratchFolder folder("options");
    const std::string sun =
        "sun --latitude-deg 5 --longitude-deg 0 --time 2026-01-01T00:00:00Z --height-m ";
    const std::string air = "path --band 8:12 --range-km ", sky = "path --band 8:12 --to-space ";
    for (const std::string number : {"nan", "inf", "-inf", "1e999", "-1e9", "0x10", "1,5", "''"}) {
        for (const std::string& arguments :
             {sun + number, air + number, sky + "--sun-zenith-deg " + number,
              sky + "--visibility-km " + number, sky + "--zenith-deg " + number,
              sky + "--csv out.csv --height-km " + number, "movie run --fps " + number,
              "mesh dem.tif --out x.ply --tolerance-m " + number,
              "visibility dem.tif --sun-azimuth-deg 3 --sun-elevation-deg " + number,
              "run scene.toml --threads " + number,
              "slurm scene.toml --out o --scripts s --shards " + number}) {
            CAPTURE(arguments);
            const Ran got = in_folder(folder.path, arguments);
            CAPTURE(got.out);
            CHECK(got.code == 2);
            CHECK(std::count(got.out.begin(), got.out.end(), '\n') == 1);
            CHECK(got.out.find("expected") != std::string::npos);
        }
    }
    CHECK(files_in(folder.path) == 0);
    CHECK(in_folder(folder.path, sun + "+400").code == 0);
}

TEST_CASE("an empty text is no name of anything", "[command_line][options]") {
    const ScratchFolder folder("empty-options");
    for (const std::string arguments :
         {"run scene.toml --out ''", "solve scene.toml --out ''", "column ''", "run ''",
          "model truck --out ''", "render scene.toml --temperatures '' --out o",
          "crossover scene.toml --out ' '", "path --band '' --to-space"}) {
        CAPTURE(arguments);
        const Ran got = in_folder(folder.path, arguments);
        CAPTURE(got.out);
        CHECK(got.code == 2);
        CHECK(got.out.find("found an empty value") != std::string::npos);
    }
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("results do not go over what they are made of", "[command_line][options]") {
    const ScratchFolder folder("own-inputs");
    std::string text = "pressure_hPa,height_m,temperature_C,relative_humidity_percent\n";
    for (int i = 0; i < 12; ++i) {
        text += std::to_string(1013 - 70 * i) + "," + std::to_string(700 * i) + "," +
                std::to_string(15 - 4 * i) + ",50\n";
    }
    write_text(folder.path / "sonde.csv", text);
    fs::create_symlink("sonde.csv", folder.path / "other.csv");
    const std::string path = "path --profile sonde.csv --band 8:12 --to-space --csv ";
    for (const std::string name : {"sonde.csv", "other.csv", "./sonde.csv"}) {
        const Ran got = in_folder(folder.path, path + name);
        CAPTURE(got.out);
        CHECK(got.code == 2);
        CHECK(got.out.find("is an input or a result of this run") != std::string::npos);
        CHECK(diurna::read_text(folder.path / "sonde.csv") == text);
    }
    CHECK(in_folder(folder.path, path + "spectrum.csv").code == 0);
}

TEST_CASE("a signal that ends the program ends what it has started and removes its folder",
          "[command_line][signals]") {
    const ScratchFolder folder("signals");
    const fs::path stub = folder.path / "stub", tmp = folder.path / "tmp";
    fs::create_directories(tmp);
    write_text(stub, "#!/bin/sh\necho $$ > " + (folder.path / "pid").string() +
                         "\nsleep 50 & echo $! >> " + (folder.path / "pid").string() + "\ntouch " +
                         (folder.path / "started").string() + "\nsleep 51\n");
    fs::permissions(stub, fs::perms::owner_all);
    for (const std::string signal : {"INT", "TERM", "HUP"}) {
        CAPTURE(signal);
        // Waits for the start, sends the signal, and counts who of the group still lives.
        const Ran got =
            ran("cd '" + folder.path.string() +
                "' && rm -f started && { TMPDIR=tmp env --default-signal=INT '" DIURNA_BINARY
                "' path --band 8:12 --to-space --modtran " +
                stub.string() +
                " > log 2>&1 & p=$!; for i in $(seq 100); do [ -e started ] && break; "
                "sleep 0.05; done; "
                "kill -" +
                signal +
                " $p; wait $p; echo code $?; sleep 0.2; for q in $(cat pid); do grep "
                "-L '^State:.[ZX]' /proc/$q/status 2>/dev/null; done; ls tmp; }");
        const int expected = signal == "INT" ? 130 : signal == "TERM" ? 143 : 129;
        CHECK(got.out == "code " + std::to_string(expected) + "\n");
    }
}

TEST_CASE("a camera in a sheet is refused, one beside it is not", "[command_line][eye]") {
    const ScratchFolder folder("eye-in-sheet");
    write_text(folder.path / "sheet.obj", "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nf 1 2 3 4\n");
    std::string text = small_scene();
    text = text.substr(0, text.find("[[observer]]"));
    text = with(text, "[weather]",
                "[[object]]\nname = \"sheet\"\nmesh = \"" + (folder.path / "sheet.obj").string() +
                    "\"\nup = \"z\"\nplace_m = [300.0, 300.0]\nheight_above_ground_m = 20.0\n"
                    "stands = \"upright\"\nmaterial = \"painted_steel\"\n[weather]");
    for (const auto& [height, code] : {std::pair{"20.0", 2}, {"20.05", 0}, {"19.9", 0}}) {
        write_text(folder.path / "scene.toml",
                   text +
                       "[[observer]]\nname = \"o\"\nplace_m = [300.0, 300.0]\n"
                       "look_at_m = [0.0, 0.0]\nbands = [\"8-12\"]\nheight_above_ground_m = " +
                       height + "\n");
        const Ran got = in_folder(folder.path, "check scene.toml --allow-outside");
        CAPTURE(height, got.out);
        CHECK(got.code == code);
        CHECK((got.out.find("camera is in a surface of \"sheet\"") != std::string::npos) ==
              (code == 2));
    }
}
