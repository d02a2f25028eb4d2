#include "materials/matter/library_parts.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <variant>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"

// Settings that change a part of a material of the library.

using namespace diurna;

namespace {

const MaterialLibrary& library() {
    static const MaterialLibrary loaded = default_material_library();
    return loaded;
}

using Settings = std::vector<std::string>;

/// Of a scene of these lines, with settings: the material of this name.
Material of_scene(const std::string& text, const Settings& settings, const std::string& name) {
    Document document = Document::from_text(text, "hill.toml");
    apply_settings(document, settings, MaterialTables::by_name);
    MaterialLibrary all = library();
    const Section materials = document.root().section("material", "materials");
    for (const std::string& one : materials.free_keys()) {
        all.add(read_material(materials.section(one, "a material"), all, one));
    }
    document.finish();
    return all[all.find(name)];
}

Material of_column(const std::string& text, const Settings& settings) {
    Document document = Document::from_text("[material]\n" + text, "column.toml");
    apply_settings(document, settings, MaterialTables::one);
    Material found =
        read_material(document.root().required_section("material", "it"), library(), "column");
    document.finish();
    return found;
}

/// The line of the only mistake.
template <class Read>
std::string refused(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.mistakes().size() == 1 ? error.mistakes().front().line()
                                            : fmt::format("{} mistakes", error.mistakes().size());
    }
    return "no mistake";
}

const Material& named(const std::string& name) { return library()[library().find(name)]; }

}  // namespace

TEST_CASE("a setting changes one layer of a library material and leaves the others",
          "[materials][library_parts][own_keys]") {
    for (const std::string& name : library().names()) {
        CAPTURE(name);
        const Material& whole = named(name);
        const Material thick =
            of_scene("", {fmt::format("material.{}.layers.0.thickness_m=0.0321", name)}, name);
        REQUIRE(thick.thermal.layers.size() == whole.thermal.layers.size());
        CHECK(thick.thermal.layers[0].thickness == Approx(0.0321).epsilon(1e-12));
        CHECK(thick.thermal.layers[0].conductivity == whole.thermal.layers[0].conductivity);
        for (std::size_t i = 1; i < whole.thermal.layers.size(); ++i) {
            CHECK(thick.thermal.layers[i].thickness == whole.thermal.layers[i].thickness);
        }
        CHECK(thick.thermal.albedo == whole.thermal.albedo);
        CHECK(thick.thermal.emissivity == whole.thermal.emissivity);
        const Material column =
            of_column("name = \"" + name + "\"\n", {"material.layers.0.thickness_m=0.0321"});
        CHECK(column.thermal.layers[0].thickness == thick.thermal.layers[0].thickness);
    }
}

TEST_CASE("a setting reaches tables that a material inherits, in the library and in the scene",
          "[materials][library_parts][own_keys]") {
    // steel_plate is like green_paint, which is like painted_sheet: back and convection are its.
    const Material steel = of_scene("", {"material.steel_plate.back.albedo=0.5"}, "steel_plate");
    REQUIRE(steel.thermal.back);
    CHECK(steel.thermal.back->albedo == 0.5);
    CHECK(steel.thermal.back->emissivity == named("steel_plate").thermal.back->emissivity);
    // road is like the scene's own asphalt, not the library's.
    const std::string text =
        "[material.asphalt]\nstore = { capacity_mm = 3.0, wet_albedo = 0.07 }\n"
        "[material.road]\nlike = \"asphalt\"\n";
    const Material road = of_scene(text, {"material.road.store.capacity_mm=4"}, "road");
    CHECK(road.thermal.store.capacity_mm == 4.0);
    CHECK(road.thermal.store.wet_albedo == 0.07);
    // What the scene gives itself is not replaced by the library's.
    const Material own = of_scene(text, {"material.asphalt.store.capacity_mm=1"}, "asphalt");
    CHECK(own.thermal.store.wet_albedo == 0.07);
}

TEST_CASE("a part that names a file of the library still finds it",
          "[materials][library_parts][own_keys]") {
    const Material dull = of_scene("", {"material.aluminium.finish.roughness=0.31"}, "aluminium");
    CHECK(std::get<Glossy>(dull.finish).roughness == Approx(0.31));
    CHECK(std::get<Glossy>(dull.finish).index.value ==
          std::get<Glossy>(named("aluminium").finish).index.value);
}

TEST_CASE("settings take effect in their order: a column's material first, then a part of it",
          "[materials][library_parts][own_keys]") {
    const Material found = of_column(
        "name = \"grass\"\n", {"material.name=asphalt", "material.layers.0.thickness_m=0.02"});
    CHECK(found.thermal.layers.size() == named("asphalt").thermal.layers.size());
    CHECK(found.thermal.layers[0].thickness == 0.02);
    CHECK(of_column("name = \"road\"\nlike = \"grass\"\n", {"material.evaporation.wetness=0.4"})
              .thermal.evaporation.wetness == 0.4);
}

TEST_CASE("a misspelt material of a setting gets one line with the nearest name",
          "[materials][library_parts][own_keys]") {
    const auto line = [](const std::string& setting) {
        return refused(
            [&] { of_scene("[material.ruts]\nlike = \"grass\"\n", {setting}, "grass"); });
    };
    CHECK(line("material.concret.albedo=0.7") ==
          "--set material.concret.albedo: unknown material \"concret\" (did you mean 'concrete'? "
          "`diurna materials` lists the library)");
    CHECK(line("material.rutz.layers.0.thickness_m=1").find("did you mean 'ruts'?") !=
          std::string::npos);
    CHECK(line("material.tarmac.albedo=0.1").find("did you mean 'asphalt'?") != std::string::npos);
    CHECK(line("material.grss={albedo=0.1}").find("did you mean 'grass'?") != std::string::npos);
    CHECK(
        line("material.asphalt.layers.7.thickness_m=1") ==
        "--set material.asphalt.layers.7.thickness_m=1: unknown layers \"7\" (by number: 0 to 2)");
    CHECK(line("material.asphalt.layers.thickness_m=1").find("expected layers.NAME.thickness_m") !=
          std::string::npos);
    CHECK(line("material.asphalt.layers.0.thickness_m=500") ==
          "--set material.asphalt.layers[0].thickness_m: found 500, expected a number from 1e-05 "
          "to 100");
    // A whole new one is no misspelling.
    CHECK(line("material.mine.like=grass") == "no mistake");
}

TEST_CASE("values that a sweep moves reach parts of library materials",
          "[materials][library_parts][own_keys]") {
    Document document = Document::from_text("[list]\nvalues = [0.3, 0.9, 0.1]\n", "hill.toml");
    move_values(document, {{"list.values.1", "material.grass.layers.1.saturation"}},
                MaterialTables::by_name);
    document.drop("list");
    const Section grass = document.root().section("material", "all").section("grass", "one");
    const std::vector<Section> layers = grass.sections("layers", "them");
    REQUIRE(layers.size() == 2);
    CHECK(layers[1].number("saturation", "of it") == 0.9);
    CHECK(layers[1].text("soil", "of it") == "loam");
    Document other = Document::from_text("[list]\nvalues = [0.3]\n", "hill.toml");
    CHECK_THROWS_WITH(
        move_values(other, {{"list.values.0", "material.gras.albedo"}}, MaterialTables::by_name),
        Catch::Contains("unknown material \"gras\"") && Catch::Contains("'grass'"));
}
