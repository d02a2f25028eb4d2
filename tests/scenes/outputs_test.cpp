#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/unfinished.hpp"
#include "tests/support/small_scene.hpp"

// Nothing goes out to a network, and what a user names by mistake as the place of results is as it
// was.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

int code_of(const std::string& command) {
    return WEXITSTATUS(std::system(("exec 2>/dev/null; " + command).c_str()));
}

std::size_t files_in(const fs::path& folder) {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        count += !entry.is_directory();
    return count;
}

}  // namespace

TEST_CASE("results take the place of no input, device or pipe", "[outputs]") {
    const ScratchFolder folder("outputs");
    const fs::path scene = folder.path / "scene.toml", weather = folder.path / "weather.csv";
    const std::string from = DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv";
    fs::copy_file(from, weather);
    write_text(scene, with(small_scene(), from, "weather.csv"));
    const std::string solve = "'" DIURNA_BINARY "' solve '" + scene.string() + "' --out ";
    for (const fs::path& target : {scene, weather}) {
        const std::string before = read_text(target);
        CHECK(code_of(solve + "'" + target.string() + "'") == 2);
        CHECK(read_text(target) == before);
    }
    const fs::path pipe = folder.path / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(code_of(solve + "'" + pipe.string() + "'") == 2);
    CHECK(fs::is_fifo(fs::status(pipe)));
    CHECK(code_of(solve + "'" + (folder.path / "none/t.nc").string() + "'") == 2);
    CHECK_THROWS_AS(write_whole_file(pipe, std::string_view("x")), InputError);
    CHECK_THROWS_AS(write_whole_file("/dev/null", std::string_view("x")), InputError);
    CHECK(fs::is_character_file("/dev/null"));
    CHECK(files_in(folder.path) == 3);
}

TEST_CASE("a place that takes no new file is refused before anything is computed", "[outputs]") {
    const ScratchFolder folder("no-place");
    const fs::path scene = folder.path / "scene.toml";
    write_text(scene, small_scene());
    // The kernel's file system has the permissions of a folder of root, and takes no file.
    CHECK_THROWS_AS(check_output_file("/proc/t.nc"), InputError);
    CHECK_FALSE(why_no_output_folder("/proc/new").empty());
    CHECK(why_no_output_folder(folder.path / "new").empty());
    for (const char* arguments : {"run SCENE --out /proc/new", "solve SCENE --out /proc/t.nc",
                                  "contrast SCENE --out /proc/new"}) {
        CAPTURE(arguments);
        const std::string command = with(arguments, "SCENE", "'" + scene.string() + "'");
        CHECK(code_of("'" DIURNA_BINARY "' " + command) == 2);
    }
    if (::geteuid() == 0) {  // as another user, who may read but not write
        const fs::path shut = folder.path / "shut";
        fs::create_directory(shut);
        fs::permissions(folder.path, fs::perms(0755));
        CHECK(code_of("setpriv --reuid=65534 --regid=65534 --clear-groups '" DIURNA_BINARY
                      "' model truck --out '" +
                      (shut / "t.obj").string() + "'") == 2);
    }
    CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a name that others have laid a link under is not written through", "[outputs]") {
    const ScratchFolder folder("links");
    const fs::path other = folder.path / "other", link = folder.path / "link";
    write_text(other, "mine");
    fs::create_symlink(other, link);
    write_whole_file(link, std::string_view("results"));
    CHECK(read_text(other) == "mine");
    CHECK(read_text(link) == "results");
    CHECK(temporary_beside(link) != temporary_beside(link));
    CHECK(is_temporary_name(temporary_beside(link).filename().string()));
}

TEST_CASE("a file that cannot be written whole is absent and the code is 1", "[outputs]") {
    CHECK(code_of("'" DIURNA_BINARY
                  "' sun --latitude-deg 40 --longitude-deg 0 --time 2026-01-01T00:00:00Z "
                  "> /dev/full") == 1);
    // No file may have more than 20 blocks of 512 bytes: as on a disk that is full.
    const ScratchFolder folder("full");
    const std::string mesh = "'" DIURNA_BINARY "' mesh " DIURNA_SOURCE_DIR
                             "/scenes/jacksboro/elevation.tif --tolerance-m 20 --out '" +
                             (folder.path / "mesh.ply").string() + "' > /dev/null";
    CHECK(code_of("ulimit -f 20; " + mesh) == 1);
    CHECK(files_in(folder.path) == 0);
    CHECK(code_of(mesh) == 0);
    CHECK(files_in(folder.path) == 1);
    const fs::path scene = folder.path / "scene.toml";
    write_text(scene, small_scene());
    CHECK(code_of("ulimit -f 20; '" DIURNA_BINARY "' solve '" + scene.string() + "' --out '" +
                  (folder.path / "t.nc").string() + "'") == 1);
    CHECK(files_in(folder.path) == 2);
}

TEST_CASE("a file of shapes sends nothing to a network", "[outputs][network]") {
    const int server = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    REQUIRE(::bind(server, reinterpret_cast<sockaddr*>(&place), size) == 0);
    REQUIRE(::listen(server, 4) == 0);
    REQUIRE(::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size) == 0);
    const ScratchFolder folder("network");
    write_text(
        folder.path / "land.geojson",
        "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"link\",\"properties\":{\"href\":"
        "\"http://127.0.0.1:" +
            std::to_string(ntohs(place.sin_port)) +
            "/crs\",\"type\":\"proj4\"}},\"features\":[{\"type\":\"Feature\",\"properties\":{},"
            "\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[-84.21,36.31],[-84.2,36.31],"
            "[-84.2,36.32],[-84.21,36.31]]]}}]}");
    write_text(folder.path / "scene.toml",
               small_scene() + "[[shapes]]\nfile = \"land.geojson\"\nmaterial = \"asphalt\"\n");
    code_of("timeout 20 '" DIURNA_BINARY "' check '" + (folder.path / "scene.toml").string() +
            "' >/dev/null");
    CHECK(::accept(server, nullptr, nullptr) < 0);  // nobody has called
    ::close(server);
}
