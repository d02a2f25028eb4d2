#include "scenes/products/report/material_pages.hpp"

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

#include "materials/base/data_folder.hpp"
#include "materials/base/files.hpp"
#include "materials/matter/read_library.hpp"
#include "scenes/products/report/material_figures.hpp"
#include "scenes/products/report/swatch_chart.hpp"

using namespace diurna;

namespace {

const MaterialLibrary& library() {
    static const MaterialLibrary loaded = default_material_library();
    return loaded;
}

struct Ran {
    int code;
    std::string out;  // stdout and stderr together
};
Ran diurna_says(const std::string& arguments) {
    FILE* pipe = popen(("'" DIURNA_BINARY "' " + arguments + " 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    Ran ran{0, ""};
    std::array<char, 4096> block{};
    while (const std::size_t count = fread(block.data(), 1, block.size(), pipe)) {
        ran.out.append(block.data(), count);
    }
    ran.code = WEXITSTATUS(pclose(pipe));
    return ran;
}

}  // namespace

TEST_CASE("materials/LIBRARY.md and its chart are what `diurna materials` prints",
          "[scenes][materials]") {
    const LibraryNotes notes = library_notes(data_folder() / "library.toml");
    INFO("print them anew: diurna materials --page > materials/LIBRARY.md");
    CHECK(materials_page(library(), notes) == read_text(data_folder() / "LIBRARY.md"));
    INFO("diurna materials --chart > materials/library.svg");
    CHECK(swatch_chart(library()) == read_text(data_folder() / "library.svg"));
}

// Brick, ASHRAE M01: 0.89 W/mK, 1920 kg/m3, 790 J/kgK; a red one is red.
TEST_CASE("the figures of a material are what its numbers make", "[scenes][materials]") {
    const MaterialFigures brick = material_figures(library()[library().find("brick")]);
    CHECK(brick.diffusivity == Approx(0.89 / (1920.0 * 790.0)));
    CHECK(brick.inertia == Approx(1161.9).margin(0.5));
    CHECK(brick.day_depth == Approx(0.1270).margin(5e-4));  // sqrt(2 a / ω), ω = 2π a day
    CHECK(brick.visible[0] > brick.visible[1]);
    CHECK(brick.visible[1] > brick.visible[2]);
    CHECK(brick.emissivity == Approx(library()[library().find("brick")].thermal.emissivity));
}

TEST_CASE("diurna materials prints one with its sources, and the nearest of a wrong name",
          "[scenes][materials]") {
    const Ran brown = diurna_says("materials brown_paint");
    CHECK(brown.code == 0);
    for (const char* text :
         {"brown_paint: 1.5 mm of sheet steel, air behind, in generic matt brown", "albedo",
          "[painted_sheet]", "conductivity_W_mK = 45.28", "spectra/brown_paint.csv", "Hunt 1977",
          "ASHRAE Fundamentals 2005"}) {
        CAPTURE(text);
        CHECK_THAT(brown.out, Catch::Contains(text));
    }
    const Ran wrong = diurna_says("materials brwn_paint");
    CHECK(wrong.code == 2);
    CHECK(wrong.out ==
          "diurna materials: unknown material 'brwn_paint' (did you mean 'brown_paint'?)\n");
    CHECK(diurna_says("materials rock --page").code == 2);
    const Ran all = diurna_says("materials");
    CHECK(all.code == 0);
    for (const std::string& name : library().names()) {
        CAPTURE(name);
        CHECK_THAT(all.out, Catch::Contains("\n" + name + " "));
    }
}
