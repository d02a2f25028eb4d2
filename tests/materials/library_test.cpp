#include "materials/matter/library.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/keys_of_page.hpp"

using namespace diurna;

namespace {

const MaterialLibrary& library() {
    static const MaterialLibrary loaded = default_material_library();
    return loaded;
}

const Material& material(const std::string& name) { return library()[library().find(name)]; }

/// Kirchhoff: what is neither sent back nor let through.
double emissivity(const Material& m, double um) {
    return 1.0 - m.reflectance.at(um) - m.transmittance.at(um);
}

/// The [material] table of a text, read against the default library.
Material read(const std::string& text) {
    const Document document = Document::from_text(text, (data_folder() / "column.toml").string());
    const Material found = read_material(
        document.root().required_section("material", "of the column"), library(), "material");
    document.finish();
    return found;
}

std::vector<Mistake> mistakes(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.mistakes();
    }
    return {};
}

/// A complete material; a key given again in `changes` would be a duplicate, so each line is named.
const std::string layer =
    "layers = [ { thickness_m = 0.05, conductivity_W_mK = 1.1, density_kg_m3 = 1500.0, "
    "heat_capacity_J_kgK = 1100.0 } ]\n";
const std::string column_toml = R"([material]
albedo = 0.2
emissivity = 0.97
roughness_length_m = 0.02
heat_roughness_length_m = 0.002
)" + layer + R"(bottom = { kind = "temperature", value_K = 285.0 }
convection = { kind = "louis" }
evaporation = { kind = "none" }
back = { kind = "none" }
)";

}  // namespace

TEST_CASE("the library has what the scenes need", "[materials][library]") {
    for (const char* name :
         {"grass", "dry_grass", "forest", "bare_soil", "rock", "asphalt", "concrete",
          "concrete_wall", "painted_steel", "galvanised_steel", "glass", "brick", "water", "sand",
          "snow",
          // paints and metals
          "painted_sheet", "green_paint", "brown_paint", "sand_paint", "low_emissivity_paint",
          "aluminium", "aluminium_polished", "aluminium_anodised", "galvanised_steel_bright",
          "solar_panel",
          // things and people
          "rubber", "wood", "clay_tile", "canvas", "camouflage_net", "skin", "clothing",
          // ground and plants
          "sandy_soil", "sandy_soil_wet", "clay_soil", "clay_soil_wet", "moist_soil", "wet_soil",
          "gravel", "conifer", "broadleaf", "crops",
          // snow and waters
          "snow_fine", "snow_medium", "snow_coarse", "ice", "lake_water", "sea_water"}) {
        CAPTURE(name);
        CHECK(material(name).name == name);
        CHECK_FALSE(material(name).thermal.layers.empty());
    }
    CHECK_THROWS_WITH(library().find("aspalt", "scene.toml:3:1: material"),
                      Catch::StartsWith("scene.toml:3:1: material: unknown material 'aspalt'") &&
                          Catch::Contains("did you mean 'asphalt'?"));
}

TEST_CASE("broadband albedo lies in the range of the literature", "[materials][library]") {
    // Oke 1987, Boundary Layer Climates, table 1.1; ACI / Levinson & Akbari 2002 for pavements.
    struct Range {
        const char* name;
        double least, most;
    };
    for (const auto& [name, least, most] :
         {Range{"grass", 0.16, 0.26}, Range{"dry_grass", 0.20, 0.30}, Range{"forest", 0.10, 0.18},
          Range{"bare_soil", 0.15, 0.30}, Range{"rock", 0.15, 0.35}, Range{"asphalt", 0.05, 0.20},
          Range{"concrete", 0.25, 0.40}, Range{"water", 0.03, 0.10}, Range{"sand", 0.35, 0.40},
          Range{"snow", 0.70, 0.90}, Range{"brick", 0.20, 0.40}, Range{"glass", 0.06, 0.09}}) {
        CAPTURE(name, material(name).thermal.albedo);
        CHECK(material(name).thermal.albedo >= least);
        CHECK(material(name).thermal.albedo <= most);
    }
}

TEST_CASE("broadband emissivity lies in the range of the literature", "[materials][library]") {
    // Oke 1987, table 1.1; Incropera, table A.11 for galvanised steel and glass (normal: 0.9).
    struct Range {
        const char* name;
        double least, most;
    };
    for (const auto& [name, least, most] :
         {Range{"grass", 0.95, 0.99}, Range{"forest", 0.97, 0.99}, Range{"bare_soil", 0.90, 0.98},
          Range{"rock", 0.88, 0.97}, Range{"asphalt", 0.93, 0.98}, Range{"concrete", 0.88, 0.97},
          Range{"water", 0.915, 0.97}, Range{"snow", 0.97, 0.995}, Range{"brick", 0.90, 0.96},
          Range{"painted_steel", 0.88, 0.96}, Range{"galvanised_steel", 0.23, 0.30},
          Range{"galvanised_steel_oxidised", 0.75, 0.88}, Range{"glass", 0.83, 0.92}}) {
        CAPTURE(name, material(name).thermal.emissivity);
        CHECK(material(name).thermal.emissivity >= least);
        CHECK(material(name).thermal.emissivity <= most);
    }
}

TEST_CASE("no material sends back and lets through more than it gets", "[materials][library]") {
    for (const std::string& name : library().names()) {
        const Material& m = material(name);
        double least = 1.0, most = 0.0;
        for (double um = 0.2; um <= 100.0; um *= 1.003) {
            least = std::min(least, emissivity(m, um));
            most = std::max(most, emissivity(m, um));
        }
        CAPTURE(name);
        CHECK(least >= -1e-12);
        CHECK(most <= 1.0);
        CHECK(m.thermal.albedo + m.thermal.solar_transmittance <= 1.0);
    }
}

TEST_CASE("glass lets the sun in and no heat out", "[materials][library]") {
    const Material& glass = material("glass");
    CHECK(glass.thermal.solar_transmittance == Approx(0.80).margin(0.03));
    CHECK(glass.transmittance.at(0.55) > 0.85);
    CHECK(glass.transmittance.at(5.0) == 0.0);
    CHECK(glass.transmittance.at(10.0) == 0.0);
    CHECK(glass.reflectance.at(9.5) > 0.2);  // the silica band
    CHECK(std::holds_alternative<Interior>(glass.thermal.bottom));
}

TEST_CASE("soil ends below the reach of the daily wave", "[materials][library]") {
    for (const char* name : {"grass", "forest", "bare_soil", "asphalt", "concrete", "sand"}) {
        double depth = 0.0, waves = 0.0;
        for (const Layer& l : material(name).thermal.layers) {
            const double diffusivity = l.conductivity / (l.density * l.heat_capacity);
            depth += l.thickness;
            waves += l.thickness / std::sqrt(2.0 * diffusivity * 86400.0 / (2.0 * 3.14159265));
        }
        CAPTURE(name);
        CHECK(depth >= 3.0);
        CHECK(waves > 10.0);
    }
}

TEST_CASE("means of a constant are the constant", "[materials][library][by_degenerate]") {
    CHECK(solar_mean(flat_spectrum(0.37)) == Approx(0.37).epsilon(1e-13));
    CHECK(planck_mean(flat_spectrum(0.37)) == Approx(0.37).epsilon(1e-13));
    CHECK(planck_mean(Spectrum{}) == 0.0);
    CHECK(solar_mean(Spectrum{}) == 0.0);
}

TEST_CASE("the Planck mean weighs a band by its share of the emission", "[materials][library]") {
    const Spectrum window{{7.9999, 8.0, 12.0, 12.0001}, {0.0, 1.0, 1.0, 0.0}};
    Spectrum wide = window;
    wide.wavelength_um.insert(wide.wavelength_um.begin(), 0.2);
    wide.wavelength_um.push_back(100.0);
    wide.value.insert(wide.value.begin(), 0.0);
    wide.value.push_back(0.0);
    // 40-digit integrals at 300 K: 8-12 um 38.5004239333 W/m2 sr; all but what lies beyond 100 um
    // (0.463 W/m2 sr, from Rayleigh-Jeans with two corrections) of 146.1998351152.
    const double x = second_radiation_um / 3e4;
    const double tail = first_radiation_um * 300.0 / second_radiation_um / 1e6 *
                        (1.0 / 3.0 - x / 8.0 + x * x / 60.0);
    CHECK(planck_mean(wide, 300.0) ==
          Approx(38.5004239333 / (146.1998351152 - tail)).epsilon(1e-4));
}

TEST_CASE("the solar mean weighs by the sun at the ground", "[materials][library]") {
    // Shares of ASTM G173 global in 0.3-4 um: 0.3-0.7 um carries 475.93 of 1000.37 W/m2
    // (integrated from the 2002 points of the standard). The table's steps soften the cut at 0.7.
    const Spectrum visible{{0.2, 0.7, 0.7001, 100.0}, {1.0, 1.0, 0.0, 0.0}};
    CHECK(solar_mean(visible) == Approx(475.93 / 1000.37).epsilon(0.01));
}

TEST_CASE("a material is read from a column file", "[materials][library]") {
    const Material m = read(column_toml);
    CHECK(m.thermal.albedo == 0.2);
    CHECK(m.thermal.emissivity == 0.97);
    CHECK(m.thermal.roughness_length == 0.02);
    CHECK(m.thermal.heat_roughness_length == 0.002);
    REQUIRE(m.thermal.layers.size() == 1);
    CHECK(m.thermal.layers[0].heat_capacity == 1100.0);
    CHECK(std::get<FixedTemperature>(m.thermal.bottom).temperature == 285.0);
    CHECK_FALSE(m.thermal.back);
    // Without spectra: flat, changing at 4 um.
    CHECK(m.reflectance.at(0.5) == Approx(0.2));
    CHECK(m.reflectance.at(3.9) == Approx(0.2));
    CHECK(emissivity(m, 4.1) == Approx(0.97));
    CHECK(emissivity(m, 10.0) == Approx(0.97));
}

TEST_CASE("every kind of bottom, convection, evaporation and back is read",
          "[materials][library]") {
    const auto with = [](const std::string& lines) {
        return read("[material]\nname = \"asphalt\"\n" + lines).thermal;
    };
    CHECK(std::get<FixedFlux>(with("bottom = { kind = \"flux\", value_W_m2 = 3.0 }").bottom).flux ==
          3.0);
    const auto room = std::get<Interior>(
        with("bottom = { kind = \"interior\", air_temperature_K = 294.0, film_W_m2K = 8 }").bottom);
    CHECK(room.air_temperature == 294.0);
    CHECK(room.film == 8.0);
    CHECK(std::get<ConstantFilm>(
              with("convection = { kind = \"constant\", value_W_m2K = 10.0 }").convection)
              .film == 10.0);
    CHECK(std::holds_alternative<Tarp>(with("convection = { kind = \"tarp\" }").convection));
    CHECK(std::holds_alternative<Mowitt>(with("convection = { kind = \"mowitt\" }").convection));
    const auto wall = std::get<Tarp>(
        with("convection = { kind = \"tarp\", length_m = 4, roughness = 1.11 }").convection);
    CHECK(wall.length == 4.0);
    CHECK(wall.roughness == 1.11);
    CHECK(std::get<Mowitt>(with("convection = { kind = \"mowitt\", roughness = 1.52 }").convection)
              .roughness == 1.52);
    const auto body = [&](const std::string& kind) {
        return std::get<BodyFilm>(with("convection = { kind = " + kind + " }").convection);
    };
    CHECK(body("\"plate\"").shape == BodyShape::plate);
    CHECK(body("\"plate\"").length == 0.0);
    CHECK(body("\"cylinder\", length_m = 0.1").shape == BodyShape::cylinder);
    CHECK(body("\"cylinder\", length_m = 0.1").length == 0.1);
    CHECK(body("\"box\"").shape == BodyShape::box);
    const Evaporation wet =
        with("evaporation = { kind = \"resistance\", minimum_s_m = 70.0, wetness = 0.5 }")
            .evaporation;
    CHECK(wet.minimum_resistance == 70.0);
    CHECK(wet.wetness == 0.5);
    const auto plate = with("back = { kind = \"exposed\", emissivity = 0.8, albedo = 0.3 }").back;
    REQUIRE(plate);
    CHECK(plate->emissivity == 0.8);
    CHECK(plate->albedo == 0.3);
    CHECK(with("internal_heat_W_m2 = 40").internal_heat == 40.0);
    const auto snow = with("snow_albedo = { fresh = 0.9, old = 0.6 }").snow_albedo;
    REQUIRE(snow);
    CHECK(snow->fresh == 0.9);
    CHECK(snow->old == 0.6);
    CHECK(with("snow_albedo = {}").snow_albedo->fresh == 0.85);
    CHECK_FALSE(with("").snow_albedo);
}

TEST_CASE("a library's material may be taken as it is or changed", "[materials][library]") {
    const Material same = read("[material]\nname = \"asphalt\"\n");
    CHECK(same.thermal.albedo == material("asphalt").thermal.albedo);
    CHECK(same.reflectance.value == material("asphalt").reflectance.value);

    const Material wet =
        read("[material]\nname = \"wet_asphalt\"\nlike = \"asphalt\"\nalbedo = 0.05\n");
    CHECK(wet.name == "wet_asphalt");
    CHECK(wet.thermal.albedo == 0.05);
    CHECK(wet.thermal.layers.size() == material("asphalt").thermal.layers.size());
    // The picture shows what the balance absorbs: the spectrum is scaled to the same mean.
    CHECK(solar_mean(wet.reflectance) == Approx(0.05).margin(1e-4));
    CHECK(wet.thermal.emissivity == Approx(material("asphalt").thermal.emissivity));
    CHECK(emissivity(wet, 10.0) == Approx(emissivity(material("asphalt"), 10.0)).epsilon(1e-9));

    const Material dull = read("[material]\nname = \"glass\"\nemissivity = 0.95\n");
    CHECK(dull.thermal.emissivity == 0.95);
    CHECK(planck_mean(dull.reflectance) == Approx(0.05).margin(0.001));
    CHECK(dull.thermal.solar_transmittance == material("glass").thermal.solar_transmittance);

    // A white asphalt cannot be had by scaling without passing 1 somewhere; the means still hold.
    const Material white = read("[material]\nname = \"asphalt\"\nalbedo = 0.9\nemissivity = 0.1\n");
    CHECK(solar_mean(white.reflectance) == Approx(0.9).margin(0.01));
    CHECK(planck_mean(white.reflectance) == Approx(0.9).margin(0.01));
}

TEST_CASE("all mistakes of a material are reported at once, with their places",
          "[materials][library]") {
    const auto found = mistakes(R"([material]
albedo = 1.2
emisivity = 0.97
emissivity = "high"
roughness_length_m = 0.0
layers = [ { thickness_m = -1, conductivity_W_mK = 1.1, density_kg_m3 = 1500.0, heat_capacity = 1 } ]
bottom = { kind = "temprature", value_K = 285.0 }
evaporation = { kind = "resistance", minimum_s_m = 70.0, wetness = 2.0 }
)");
    std::vector<std::string> lines;
    for (const Mistake& mistake : found) lines.push_back(mistake.line());
    const std::string all = [&] {
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        return text;
    }();
    CAPTURE(all);
    CHECK_THAT(all, Catch::Contains("column.toml:2:10: material.albedo: found 1.2"));
    CHECK_THAT(all,
               Catch::Contains("column.toml:3:1: material.emisivity: unknown key (did you mean "
                               "'emissivity'?)"));
    CHECK_THAT(all, Catch::Contains("column.toml:4:14: material.emissivity: found"));
    CHECK_THAT(all, Catch::Contains("column.toml:5:22: material.roughness_length_m"));
    CHECK_THAT(all, Catch::Contains("material.layers[0].thickness_m: found -1"));
    CHECK_THAT(all, Catch::Contains("material.layers[0].heat_capacity_J_kgK: missing"));
    CHECK_THAT(all, Catch::Contains("material.layers[0].heat_capacity: unknown key"));
    CHECK_THAT(all, Catch::Contains("did you mean 'temperature'?"));
    CHECK_THAT(all, Catch::Contains("material.evaporation.wetness: found 2"));
    CHECK(found.size() == 9);  // each once
}

TEST_CASE("what is missing from a material is named", "[materials][library]") {
    CHECK(mistakes("[material]\nalbedo = 0.2\nemissivity = 0.9\nroughness_length_m = 0.01\n")
              .front()
              .line()
              .find("material.layers: missing") != std::string::npos);
    const auto unknown = mistakes("[material]\nname = \"asphlt\"\n");
    REQUIRE(unknown.size() == 1);
    CHECK(unknown.front().line() ==
          (data_folder() / "column.toml").string() +
              ":2:8: material.name: unknown material 'asphlt' in the library (did you mean "
              "'asphalt'?)");
    CHECK(mistakes("[material]\nname = \"x\"\nlike = \"gras\"\n").front().hint ==
          "did you mean 'grass'?");
    const auto no_file = mistakes("[material]\nname = \"x\"\nreflectance = \"none.csv\"\n" + layer +
                                  "roughness_length_m = 0.01\n");
    REQUIRE(no_file.size() == 1);
    CHECK_THAT(no_file.front().line(),
               Catch::Contains("no such file: ") && Catch::Contains("none.csv"));
}

TEST_CASE("a sheet with an open back has no room behind it", "[materials][library]") {
    const std::string window =
        "[material]\nname = \"window\"\nlike = \"glass\"\n"
        "back = { kind = \"exposed\", emissivity = 0.84, albedo = 0.1 }\n";
    const Material sheet = read(window);
    REQUIRE(sheet.thermal.back);
    CHECK(std::get<FixedFlux>(sheet.thermal.bottom).flux == 0.0);
    CHECK(mistakes(window + "bottom = { kind = \"flux\", value_W_m2 = 0.0 }\n").empty());
    const auto both = mistakes(window + "bottom = { kind = \"temperature\", value_K = 290.0 }\n");
    REQUIRE(both.size() == 1);
    CHECK(both.front().hint == "remove `bottom` or `back`");
}

TEST_CASE("more than all of the light is refused", "[materials][library]") {
    const auto found =
        mistakes("[material]\nname = \"glass\"\nreflectance = \"spectra/snow.csv\"\n");
    REQUIRE_FALSE(found.empty());
    CHECK_THAT(found.front().line(), Catch::Contains("add up to 1."));
}

TEST_CASE("a material of the same name replaces, another is added", "[materials][library]") {
    MaterialLibrary own = library();
    const std::size_t before = own.size();
    const MaterialId grass = own.find("grass");
    Material changed = own[grass];
    changed.thermal.albedo = 0.5;
    CHECK(own.add(changed) == grass);
    CHECK(own.size() == before);
    CHECK(own[grass].thermal.albedo == 0.5);
    changed.name = "astroturf";
    CHECK(own.add(changed) == static_cast<MaterialId>(before));
    CHECK(own.size() == before + 1);
}
