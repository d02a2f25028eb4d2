#include "scenes/job/plan/target_sight.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "tests/support/slope_scene.hpp"

using namespace diurna;
using namespace slope_scene;

namespace {

/// A wall of earth 12 m high, 30 m north of a crate of 3 m.
Ground ridge() {
    return [](double, double north) {
        return 500.0 + 12.0 * std::exp(-std::pow((north - 30.0) / 6.0, 2));
    };
}

std::string around(const std::string& rest) {
    return "[[observer]]\nname = \"cam\"\naround = { object = \"crate\", range_m = 50.0, " + rest +
           " }\nhorizontal_fov_deg = 8.0\nwidth = 32\nheight = 24\nsamples = 1\nbands = "
           "[\"8-12\"]\n";
}

Prepared seen(const ScratchFolder& folder, const std::string& rest) {
    write_text(folder.path / "crate.obj", box(3.0, 3.0, 3.0));
    return prepare(read_scene(
        written(folder.path, ridge(), object("crate", "place_m = [0.0, 0.0]"), around(rest))));
}

double share_of(const Prepared& scene) {
    return target_sight(scene.world, scene.rays, scene.sequences[0].at(0), "crate").share();
}

bool warned(const Prepared& scene) {
    const auto lines = as_lines(view_warnings(scene));
    return std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.find("observer.cam") != std::string::npos &&
               line.find("hides") != std::string::npos;
    });
}

}  // namespace

TEST_CASE("a camera behind a ridge is warned of, one before it is not", "[scenes][around]") {
    const ScratchFolder folder("sight");
    // The front faces north: aspect 0 looks from behind the ridge, 180 from the south; from 45
    // degrees above it looks over the ridge.
    const Prepared behind = seen(folder, "aspect_deg = 0.0, elevation_deg = 3.0");
    CHECK(share_of(behind) == 0.0);
    CHECK(warned(behind));
    for (const char* free :
         {"aspect_deg = 180.0, elevation_deg = 3.0", "aspect_deg = 0.0, elevation_deg = 45.0"}) {
        CAPTURE(free);
        const Prepared scene = seen(folder, free);
        CHECK(share_of(scene) > 0.95);
        CHECK_FALSE(warned(scene));
    }
}

TEST_CASE("a hidden target is drawn again at the same range, the same each time",
          "[scenes][around]") {
    const ScratchFolder folder("sight_again");
    const std::string again = ", elevation_deg = 3.0, if_hidden = \"draw_again\"";
    const Prepared scene = seen(folder, "aspect_deg = 0.0" + again);
    CHECK(share_of(scene) >= seen_above);
    CHECK_FALSE(warned(scene));
    const Eigen::Vector3d eye = scene.sequences[0].at(0).position;
    const Eigen::Vector3d middle(0.0, 0.0, 1.5);
    CHECK((eye - middle).norm() == Approx(50.0).margin(0.2));
    const std::string& note = scene.sequences[0].note;
    CHECK(note.find("redrawn: aspect") != std::string::npos);
    CHECK(std::find(scene.notes.begin(), scene.notes.end(), note) != scene.notes.end());
    CHECK(seen(folder, "aspect_deg = 0.0" + again).sequences[0].at(0).position == eye);
    // One that is seen stays where it is.
    const Prepared free = seen(folder, "aspect_deg = 180.0" + again);
    CHECK(free.sequences[0].note.empty());
    CHECK(free.sequences[0].at(0).position ==
          seen(folder, "aspect_deg = 180.0, elevation_deg = 3.0").sequences[0].at(0).position);
}
