// The radiance of pixels added up again (tests/support/redone.hpp), within 0.5 %.

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "scenes/job/run/job.hpp"
#include "tests/support/redone.hpp"

using namespace redone;

namespace {

Found checked(const Job& job, const std::string& observer, const std::string& band,
              const char* time) {
    const Found found = redo(job, observer, band, time);
    CAPTURE(observer, band, time, found.worst, found.mixed, found.partly_lit, found.two_levels);
    CHECK(found.pixels == 200);
    CHECK(found.worst < 0.005);
    return found;
}

}  // namespace

TEST_CASE("a textured runway and a hangar are redone from planes and library",
          "[whole][redone][by_trace]") {
    const Job job(airfield());
    for (const char* time : {"040000", "120000", "200000"}) {
        for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
            if (std::string(band) == "0.62-0.66" && std::string(time) == "040000") continue;
            const Found found = checked(job, "east", band, time);
            CHECK(found.two_levels > 10);  // of 200: the scene has such pixels
        }
    }
}

// Two rows of buildings with a street between them: walls light each other.
TEST_CASE("a street is redone from planes and library", "[whole][redone][by_trace]") {
    std::string text = airfield();
    for (const char* place : {"[53.0, -108.4]", "[20.0, -60.0]"}) {
        text += "[[building]]\nname = \"" + std::string(place) + "\"\nplace_m = " + place +
                "\nwidth_m = 60.0\ndepth_m = 12.0\nheight_m = 15.0\nheading_deg = 45.0\nwall = "
                "\"painted_steel\"\nroof = \"concrete\"\n";
    }
    text = with(text, "place_m = [53.0, -88.4]", "place_m = [53.0, -20.4]");
    text = with(text, "height_above_ground_m = 40.0", "height_above_ground_m = 130.0");
    text = with(text, "look_at_m = [60.0, 0.0]", "look_at_m = [30.0, -50.0]");
    const Job job(text);
    for (const char* band : {"3-5", "8-12", "0.62-0.66"})
        CHECK(checked(job, "east", band, "200000").partly_lit > 2);
}

// Anywhere in the picture, and where a mirror or a pane is seen.
TEST_CASE("a net, a pane, a mirror and smoke are redone from planes and library",
          "[whole][redone][by_trace]") {
    const std::string folder = std::string(DIURNA_SOURCE_DIR) + "/scenes/";
    std::ostringstream file;
    file << std::ifstream(folder + "camouflage/scene.toml").rdbuf();
    std::string text = file.str();
    for (std::size_t at; (at = text.find("../jacksboro")) != std::string::npos;) {
        text.replace(at, 12, folder + "jacksboro");
    }
    for (const char* mesh : {"net.obj", "pane.obj", "sheet.obj", "smoke.csv"}) {
        text = with(text, std::string("\"") + mesh, "\"" + folder + "camouflage/" + mesh);
    }
    text = with(text, "frame_every_s = 21600.0", "frame_every_s = 43200.0");
    text = with(text, "width = 480", "width = 160");
    text = with(text, "height = 240", "height = 80");
    text = with(text, "terms = true", "surfaces = 24");
    text = with(text, "\"visible\", \"mwir\", \"lwir\"", "\"3-5\", \"8-12\", \"0.62-0.66\"");
    text = with(text, "step_s = 600.0", "step_s = 1200.0");
    text = with(text, "sky_rays = 64", "sky_rays = 32");
    const Job job(text);
    for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
        checked(job, "south", band, "160000");
        const Found mirrors = redo_mirrors(job, "south", band, "160000");
        CAPTURE(band, mirrors.pixels, mirrors.worst, mirrors.not_listed);
        CHECK(mirrors.pixels == 200);
        CHECK(mirrors.worst < 0.005);
    }
}

// A pond and a hangar's glass front, seen from low: what they mirror is listed with what is met
// there, and the reflectances are those of the library's n and k.
TEST_CASE("water and window glass are redone from planes and library",
          "[whole][redone][by_trace]") {
    const Job job(waterside(GENERATE("15.0", "70.0")));
    for (const char* time : {"040000", "120000", "200000"}) {
        for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
            if (std::string(band) == "0.62-0.66" && std::string(time) == "040000") continue;
            const Found found = redo_mirrors(job, "east", band, time);
            CAPTURE(band, time, found.worst, found.not_listed, found.off_fresnel);
            CHECK(found.pixels == 200);
            CHECK(found.worst < 0.005);
            CHECK(found.not_listed < 100);
            CHECK(found.off_fresnel < 0.01);
        }
    }
}
