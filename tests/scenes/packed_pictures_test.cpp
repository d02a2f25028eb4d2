#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <string>

#include "render/picture/exr.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;
namespace fs = std::filesystem;

TEST_CASE("packed pictures have every plane as it was, in less room", "[scenes][output]") {
    const ScratchFolder folder("packed_pictures");
    write_text(folder.path / "scene.toml", small_scene());
    const auto made = [&](const std::string& out, const std::string& more) {
        const Ran done = ran(
            fmt::format("'" DIURNA_BINARY "' run '{}' --out '{}' --progress none {} 2>&1",
                        (folder.path / "scene.toml").string(), (folder.path / out).string(), more));
        REQUIRE(done.code == 0);
        for (const auto& entry : fs::directory_iterator(folder.path / out / "frames")) {
            if (entry.path().extension() == ".exr") return entry.path();
        }
        FAIL("no picture");
        return fs::path();
    };
    const fs::path plain = made("plain", "");
    const fs::path packed = folder.path / "zip" / "frames" / plain.filename();
    made("zip", "--set output.compression=zip");
    CHECK(double(fs::file_size(packed)) < 0.8 * double(fs::file_size(plain)));
    const Frame one = read_exr(plain), other = read_exr(packed);
    REQUIRE(one.planes.size() == other.planes.size());
    for (std::size_t p = 0; p < one.planes.size(); ++p) {
        CAPTURE(one.planes[p].name);
        CHECK(std::memcmp(one.planes[p].pixel.data(), other.planes[p].pixel.data(),
                          one.planes[p].pixel.size() * sizeof(float)) == 0);
    }
}
