#include "scenes/job/input/bands.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "materials/base/error.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

const std::string own_bands = R"([[bands]]
name = "camera"
response = "camera.csv"
[[bands]]
name = "window"
range_um = [10.0, 11.0]
[[cubes]]
name = "lines"
range_um = [9.0, 11.0]
channels = 8
)";

/// The small scene with bands of its own, beside a response file.
struct BandScene {
    ScratchFolder folder{"scene-bands"};
    std::filesystem::path file = folder.path / "scene.toml";

    explicit BandScene(const std::string& text) {
        write_text(folder.path / "camera.csv", "wavelength_um,response\n7.5,0\n8,1\n12,1\n13,0\n");
        write_text(file, text);
    }
    std::vector<Mistake> mistakes() const {
        try {
            read_scene(file);
        } catch (const InputError& error) {
            return error.mistakes();
        }
        return {};
    }
};

std::string scene_text() {
    return with(
        small_scene(), "bands = [\"3-5\", \"8-12\"]",
        "bands = [\"8-12\", \"camera\", \"window\", \"mwir\"]\ncubes = [\"lines\"]\n" + own_bands);
}

}  // namespace

TEST_CASE("a scene names bands by response file, range or word", "[scenes][bands]") {
    const BandScene world(scene_text());
    REQUIRE(world.mistakes().empty());
    const Scene scene = read_scene(world.file);
    CHECK(named_band(scene.bands, "camera").width_um() == Approx(4.75));
    CHECK(named_band(scene.bands, "window").from_um() == 10.0);
    CHECK(named_band(scene.bands, "mwir").to_um() == 5.0);
    CHECK(named_band(scene.bands, "visible").from_um() == 0.4);
    CHECK(named_band(scene.bands, "8-14").to_um() == 14.0);
    CHECK_THROWS_AS(named_band(scene.bands, "camra"), InputError);
}

TEST_CASE("mistakes in bands and cubes are reported", "[scenes][bands]") {
    const auto one = [](const std::string& from, const std::string& to) {
        const auto found = BandScene(with(scene_text(), from, to)).mistakes();
        CAPTURE(from, to);
        REQUIRE(found.size() == 1);
        return found[0].line();
    };
    CHECK_THAT(one("\"camera\", \"window\"", "\"camra\", \"window\""),
               Catch::Contains("observer.bands") && Catch::Contains("did you mean 'camera'"));
    CHECK_THAT(one("cubes = [\"lines\"]", "cubes = [\"line\"]"),
               Catch::Contains("observer.cubes") && Catch::Contains("did you mean 'lines'"));
    CHECK_THAT(one("camera.csv", "nowhere.csv"), Catch::Contains("bands.camera.response"));
    CHECK_THAT(one("range_um = [9.0, 11.0]", "range_um = [11.0, 9.0]"),
               Catch::Contains("cubes.range_um"));
    CHECK_THAT(one("channels = 8", "chanels = 8"), Catch::Contains("unknown key"));
    CHECK_THAT(one("channels = 8", "channels = 0"), Catch::Contains("cubes.channels"));
    CHECK_THAT(one("[[cubes]]", "[[bands]]\nname = \"window\"\nrange_um = [9.5, 11.0]\n[[cubes]]"),
               Catch::Contains("a second"));
}

TEST_CASE("a job writes its bands and cubes", "[scenes][bands]") {
    const BandScene world(with(scene_text(), "frame_every_s = 21600.0", "frame_every_s = 86400.0"));
    const std::filesystem::path out = world.folder.path / "out";
    REQUIRE(std::system(("'" DIURNA_BINARY "' run '" + world.file.string() + "' --out '" +
                         out.string() + "' > /dev/null 2>&1")
                            .c_str()) == 0);
    const std::filesystem::path frames = out / "frames";
    const Frame flat = read_exr(frames / "east_8-12_20260715T040000Z.exr");
    const Frame curve = read_exr(frames / "east_camera_20260715T040000Z.exr");
    const Frame cube = read_exr(frames / "east_lines_20260715T040000Z.exr");
    CHECK(std::filesystem::file_size(frames / "east_lines_20260715T040000Z.img") ==
          8 * 64 * 48 * sizeof(float));
    CHECK(std::filesystem::exists(frames / "east_lines_20260715T040000Z.hdr"));
    REQUIRE(cube.planes.size() == 8);
    const auto& wide = flat["radiance.8-12"].pixel;
    const auto& camera = curve["radiance.camera"].pixel;
    for (const std::size_t p : {64u * 24u + 32u, 64u * 40u + 10u}) {
        // The response holds 8-12 µm whole and half of half a micrometre and a micrometre beside.
        CHECK(camera[p] > wide[p]);
        CHECK(camera[p] < 1.25f * wide[p]);
        // 2 of the 4 µm, per nanometre: the cube's mean times 2000 nm is less than the band's.
        double sum = 0.0;
        for (const Plane& plane : cube.planes) sum += 250.0 * double{plane.pixel[p]};
        CHECK(sum > 0.45 * double{wide[p]});
        CHECK(sum < 0.6 * double{wide[p]});
    }
}

// Rows of the file end at 11 µm: beyond, its last row would represent lines of the spectrum that
// nobody has measured.
TEST_CASE("a file of n and k that is short of a band is refused", "[scenes][bands]") {
    const auto mistakes = [](const std::string& law, double from, double to) {
        BandScene world("");
        write_text(world.folder.path / "varnish.csv", "wavelength_um,n,k\n" + std::to_string(from) +
                                                          ",1.5,0\n" + std::to_string(to) +
                                                          ",1.6,0.1\n");
        write_text(world.file, small_scene() +
                                   "[material.varnished]\nlike = \"painted_steel\"\nfinish = { " +
                                   law + ", index_file = \"varnish.csv\" }\n");
        return world.mistakes();
    };
    const std::string gloss = "kind = \"gloss\", roughness = 0.1",
                      metal = "kind = \"metal\", roughness = 0.1",
                      effective = ", effective_index = true";
    CHECK(mistakes(gloss, 3.0, 12.0).empty());
    const auto short_of = mistakes(gloss, 3.0, 11.0);
    REQUIRE(short_of.size() == 1);
    const std::string line = short_of[0].line();
    CAPTURE(line);
    CHECK(line.find("scene.toml:49:58: material.varnished.finish.index_file: ") !=
          std::string::npos);
    CHECK(short_of[0].problem ==
          "band 8-12 needs n and k from 8 to 12 um, the file has 3 to 11 um");
    CHECK(short_of[0].hint == "add rows to the file, or set effective_index = true (beyond 4 um)");
    CHECK(mistakes(gloss, 3.5, 20.0).size() == 1);
    CHECK(mistakes(metal, 3.0, 11.0).at(0).hint == "add rows to the file");
    CHECK(mistakes(gloss + effective, 2.0, 4.5).empty());
    CHECK(mistakes(gloss + effective, 2.0, 3.5).size() == 1);
    CHECK(mistakes(metal + effective, 1.0, 2.0).empty());
}
