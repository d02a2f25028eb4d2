#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/confined_place.hpp"

// Names of a scene and of its files, in all that is written and printed (SECURITY.md).

using namespace confined;

namespace {

const PrivateTempFolder temp;

}  // namespace

TEST_CASE("names in files neither steer a terminal nor write into a report", "[confinement]") {
    const Place place;
    const auto check = [&] {
        return run_diurna("check '" + (place.yard / "scene.toml").string() + "'");
    };
    for (const std::string& name :
         {std::string(R"(a\u001b[31mb)"), std::string(R"(a\nb)"), std::string(R"(a\u009bb)"),
          std::string(R"(a\u202eb)"), std::string(R"(a\u0000b)"), std::string(R"(a\u007fb)")}) {
        CAPTURE(name);
        for (const More& more :
             {More{.tables = "[[plume]]\nname = \"" + name +
                             "\"\nplace_m = [5.0, 5.0]\nheight_m = 3.0\n"
                             "radius_m = 1.0\ntemperature_K = 300.0\nabsorption_per_m = 1.0\n"},
              More{.tables = "[material.\"" + name + "\"]\nlike = \"concrete\"\n"},
              More{.object = "class = \"" + name + "\"\n"}, More{.weather = name},
              More{.object = "parts = { \"" + name + "\" = \"concrete\" }\n"}}) {
            place.write(more);
            const Ran ran = check();
            CAPTURE(ran.out);
            CHECK(ran.code == 2);
            for (const char* steers : {"\x1b", "\x7f", "\xc2\x9b", "\xe2\x80\xae"}) {
                CHECK(ran.out.find(steers) == std::string::npos);
            }
        }
    }
    // What other files call their parts is taken over without what steers.
    place.write({.mesh = "named.obj", .object = "parts = { none = \"concrete\" }\n"});
    write_text(place.yard / "named.obj", "g \x1b[2Jpart\xff\n" + crate_mesh);
    const Ran ran = check();
    CHECK(ran.code == 2);
    CHECK_THAT(ran.out, Catch::Contains("?[2Jpart?"));
}

// HTML's five characters (WHATWG, "Serialising HTML fragments"), JSON's strings (RFC 8259).
TEST_CASE("no name writes into a page, a chart or a JSON text", "[confinement][report]") {
    const Place place;
    const std::string quoted = R"q("<script>alert('x')</script>&\\\"])]>")q";
    std::string text = Place::text(
        {.tables = "[material." + quoted + "]\nlike = \"concrete\"\n[[ground]]\nname = " + quoted +
                   "\nmaterial = " + quoted + "\nrectangle_m = [20.0, 0.0, 20.0, 20.0, 0.0]\n"});
    text = with(text, "[scene]\n", "[scene]\nname = " + quoted + "\n");
    text = with(text, "name = \"east\"", "name = " + quoted);
    text = with(text, "name = \"crate\"", "name = \"crate " + quoted.substr(1));
    write_text(place.yard / "scene.toml", text);
    const fs::path out = place.folder.path / "out";
    const Ran ran = run_diurna("run '" + (place.yard / "scene.toml").string() +
                               "' --progress json --out '" + out.string() + "'");
    CAPTURE(ran.out);
    REQUIRE(ran.code == 0);
    std::istringstream lines(ran.out);
    std::size_t stages = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("{\"stage\"", 0) != 0) continue;
        ++stages;
        CHECK(nlohmann::json::accept(line));
    }
    CHECK(stages > 3);
    std::size_t pages = 0, jsons = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file()) continue;
        CAPTURE(entry.path().string());
        std::ostringstream content;
        content << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        if (extension == ".html" || extension == ".svg") {
            ++pages;
            // Of scripts there is the page's own alone, at its end.
            const std::string page = content.str();
            CHECK(page.find("<script") == page.find("<script>\"use strict\";\n"));
            CHECK(page.find("<script") == page.rfind("<script"));
            CHECK(content.str().find("&lt;script&gt;alert(&#39;x") != std::string::npos);
        } else if (extension == ".json") {
            ++jsons;
            CHECK(nlohmann::json::accept(content.str()));
        }
    }
    CHECK(pages == 1);
    CHECK(jsons >= 2);
}
