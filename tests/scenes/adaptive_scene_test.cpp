#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "materials/base/error.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// The small scene, one frame, sampled as one line of its observer says.
struct SampledScene {
    ScratchFolder folder{"adaptive-scene"};
    std::filesystem::path file = folder.path / "scene.toml";

    explicit SampledScene(const std::string& sampling) {
        write_text(file, with(with(small_scene(), "samples = 16", sampling),
                              "frame_every_s = 21600.0", "frame_every_s = 86400.0"));
    }
    std::string mistake() const {
        try {
            read_scene(file);
        } catch (const InputError& error) {
            return error.mistakes().front().line();
        }
        return "";
    }
    Frame picture() const {
        const std::filesystem::path out = folder.path / "out";
        REQUIRE(std::system(("'" DIURNA_BINARY "' run '" + file.string() + "' --out '" +
                             out.string() + "' > /dev/null 2>&1")
                                .c_str()) == 0);
        return read_exr(out / "frames" / "east_8-12_20260715T040000Z.exr");
    }
};

double rms(const Frame& a, const Frame& b) {
    const auto &x = a["apparent_temperature.8-12"].pixel, &y = b["apparent_temperature.8-12"].pixel;
    double sum = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) sum += std::pow(double{x[p]} - double{y[p]}, 2);
    return std::sqrt(sum / double(x.size()));
}

}  // namespace

TEST_CASE("a scene requests adaptive sampling", "[scenes][adaptive]") {
    const SampledScene scene("adaptive = { from = 8, to = 64, tolerance_K = 0.05 }");
    REQUIRE(scene.mistake().empty());
    const auto adaptive = read_scene(scene.file).observers[0].adaptive;
    REQUIRE(adaptive);
    CHECK(adaptive->from == 8);
    CHECK(adaptive->to == 64);
    CHECK(adaptive->tolerance == 0.05);
    CHECK_THAT(SampledScene("adaptive = { from = 32, to = 16 }").mistake(),
               Catch::Contains("adaptive.to") && Catch::Contains("16 is less than from, 32"));
    CHECK_THAT(SampledScene("adaptive = { tolerance_K = 0 }").mistake(),
               Catch::Contains("adaptive.tolerance_K"));
    CHECK_THAT(SampledScene("adaptive = { least = 4 }").mistake(), Catch::Contains("unknown key"));
    CHECK_THAT(SampledScene("samples = 16\nadaptive = { from = 16 }").mistake(),
               Catch::Contains("observer.samples"));
}

TEST_CASE("a job samples as its tolerance requires", "[scenes][adaptive]") {
    const Frame truth = SampledScene("samples = 900").picture();
    const double rough = rms(SampledScene("adaptive = { from = 16, to = 16 }").picture(), truth);
    const double fine = rms(
        SampledScene("adaptive = { from = 16, to = 512, tolerance_K = 0.03 }").picture(), truth);
    CAPTURE(rough, fine);
    CHECK(rough > 0.03);
    CHECK(fine < 0.03);
}
