#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/data_folder.hpp"
#include "materials/base/document.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"
#include "materials/matter/spectrum_notes.hpp"
#include "tests/support/small_scene.hpp"

// What a material is that is like another.

using namespace diurna;

namespace {

const MaterialLibrary& library() {
    static const MaterialLibrary loaded = default_material_library();
    return loaded;
}

/// A material "m" of these lines, in a library that may have more than the program's.
Material read(const std::string& lines, const MaterialLibrary& base = library(),
              const std::filesystem::path& folder = data_folder()) {
    const Document document =
        Document::from_text("[m]\n" + lines, (folder / "scene.toml").string());
    Material found = read_material(document.root().required_section("m", "a material"), base, "m");
    document.finish();
    return found;
}

void check_alike(const Material& a, const Material& b) {
    CHECK(a.thermal.albedo == b.thermal.albedo);
    CHECK(a.thermal.emissivity == b.thermal.emissivity);
    CHECK(a.thermal.solar_transmittance == b.thermal.solar_transmittance);
    CHECK(a.reflectance.value == b.reflectance.value);
    CHECK(a.transmittance.value == b.transmittance.value);
    CHECK(a.cover == b.cover);
    CHECK(a.see_through == b.see_through);
    CHECK(a.finish.index() == b.finish.index());
}

const std::string plain_body =
    "roughness_length_m = 0.01\nlayers = [{ thickness_m = 0.1, conductivity_W_mK = 1.0, "
    "density_kg_m3 = 1000.0, heat_capacity_J_kgK = 1000.0 }]\n";

}  // namespace

TEST_CASE("a material that is like another and has no other key is that one, in scene and column",
          "[materials][like][own_keys]") {
    for (const std::string& name : library().names()) {
        CAPTURE(name);
        const Material& given = library()[library().find(name)];
        check_alike(read("like = \"" + name + "\"\n"), given);
        check_alike(read("name = \"" + name + "\"\n"), given);  // as column files do
        check_alike(read("like = \"" + name + "\"\ninternal_heat_W_m2 = 5.0\n"), given);
    }
}

// Dunkle 1965 (Modest, Radiative Heat Transfer, 3.80 and figure 3.18): a smooth dielectric of n =
// 1.5 emits 0.96 upright and 0.908 over the hemisphere.
TEST_CASE("a law of angle of the user's own is handed on", "[materials][like][own_keys]") {
    MaterialLibrary base = library();
    Material coat = read(
        "albedo = 0.3\nreflectance = \"spectra/asphalt.csv\"\n"
        "finish = { kind = \"gloss\", roughness = 0.0, index = 1.5 }\n" +
        plain_body);
    coat.name = "coat";
    base.add(coat);
    check_alike(read("like = \"coat\"\n", base), coat);

    Material smooth = read("albedo = 0.3\nemissivity = 0.96\n" + plain_body);
    smooth.name = "smooth";
    base.add(smooth);
    const std::string law =
        "finish = { kind = \"gloss\", roughness = 0.0, index = 1.5, effective_index = true }\n";
    Material over = read("like = \"smooth\"\n" + law, base);
    CHECK(over.thermal.emissivity == Approx(0.908).margin(2e-3));
    over.name = "over";
    base.add(over);
    CHECK(read("like = \"over\"\n", base).thermal.emissivity == Approx(0.908).margin(2e-3));
    // Another albedo is none of heat's business.
    const Material brighter = read("like = \"over\"\nalbedo = 0.5\n", base);
    CHECK(brighter.thermal.emissivity == over.thermal.emissivity);
    CHECK(brighter.thermal.albedo == 0.5);
    // Dull again, it emits as upright.
    const Material dull = read("like = \"over\"\nfinish = { kind = \"lambert\" }\n", base);
    CHECK(dull.thermal.emissivity == Approx(0.96).margin(2e-3));
}

// Payne 1972, J. Atmos. Sci. 29, 959: the sea's albedo under overcast is 0.061 ± 0.005; the index
// of sea water and of lakes differs from water's by less than 0.01 (Segelstein 1981; Friedman
// 1969).
TEST_CASE("sea and lake are as bright and as black over the hemisphere as water",
          "[materials][like][own_keys]") {
    const ThermalSurface& water = library()[library().find("water")].thermal;
    for (const char* name : {"sea_water", "lake_water"}) {
        const ThermalSurface& own = library()[library().find(name)].thermal;
        CAPTURE(name, own.albedo, own.emissivity);
        CHECK(own.emissivity == Approx(water.emissivity).margin(2e-3));
        CHECK(own.albedo >= 0.056);
        CHECK(own.albedo <= 0.09);  // turbid lakes: a few hundredths of light from within
    }
}

// A net of cover c: c ρ sent back, 1 − c + c τ let through; its heat is that of its strips.
TEST_CASE("a net's strips stay what they are whatever they cover",
          "[materials][like][own_keys][net]") {
    const Material& net = library()[library().find("camouflage_net")];
    REQUIRE(net.cover == 0.65);
    const Material thinner = read("like = \"camouflage_net\"\ncover = 0.5\n");
    CHECK(thinner.cover == 0.5);
    CHECK(thinner.thermal.albedo == net.thermal.albedo);
    CHECK(thinner.thermal.emissivity == net.thermal.emissivity);
    for (const double um : {0.55, 4.0, 10.0}) {
        CAPTURE(um);
        CHECK(net.transmittance.at(um) == Approx(0.35));
        CHECK(thinner.transmittance.at(um) == Approx(0.5));
        CHECK(thinner.reflectance.at(um) / 0.5 == Approx(net.reflectance.at(um) / 0.65));
    }
    const Material bright = read("like = \"camouflage_net\"\nalbedo = 0.6\n");
    CHECK(bright.thermal.albedo == 0.6);
    CHECK(bright.thermal.solar_transmittance == 0.0);
    CHECK(bright.thermal.emissivity == net.thermal.emissivity);
    CHECK(solar_mean(bright.reflectance) == Approx(0.65 * 0.6).margin(0.01));
    CHECK(bright.transmittance.at(0.55) == Approx(0.35));
}

// Of the sun at the ground (ASTM G173, global) 96 % lies within 0.35 to 2.5 µm, of a black body at
// 300 K 0.02 % (Planck's fractions: 0.0000 to 750 µm K).
// The ends are those of the tables' first and last rows (materials/spectra/*_refraction.csv).
TEST_CASE("a band past the ends of the library's own n and k is reported",
          "[materials][like][own_keys][spectrum]") {
    const std::vector<Band> bands{flat_band("8-12", 8.0, 12.0), flat_band("far", 20.0, 30.0),
                                  flat_band("uv", 0.25, 0.4)};
    const auto reported = [&](const std::string& name) {
        std::vector<std::string> of_index;
        for (const std::string& note : spectrum_notes(library()[library().find(name)], bands)) {
            if (note.find("n and k") != std::string::npos) of_index.push_back(note);
        }
        return of_index;
    };
    REQUIRE(reported("ice").size() == 2);
    CHECK_THAT(reported("ice")[0], Catch::Contains("n and k cover 0.3 to 25 µm") &&
                                       Catch::Contains("affects band far"));
    CHECK_THAT(reported("ice")[1], Catch::Contains("affects band uv"));
    for (const char* name : {"water", "glass"}) {
        REQUIRE(reported(name).size() == 1);
        CHECK_THAT(reported(name)[0],
                   Catch::Contains("over 0.3 to 100 µm") && Catch::Contains("affects band uv"));
    }
    REQUIRE(reported("aluminium").size() == 1);
    CHECK_THAT(reported("aluminium")[0], Catch::Contains("over 0.30996 to 99.996 µm"));
    CHECK(reported("painted_steel").empty());
    CHECK(reported("asphalt").empty());
}

TEST_CASE("a spectrum is of the quantity that its column names",
          "[materials][like][own_keys][spectrum]") {
    const ScratchFolder folder("quantity");
    write_text(folder.path / "eps.csv", "wavelength_um,Emissivity (1)\n0.3,0.4\n50,0.4\n");
    write_text(folder.path / "rho.csv", "wavelength_um,reflectance\n0.3,0.6\n50,0.6\n");
    write_text(folder.path / "cent.csv", "wavelength_um,reflectance_percent\n50,60\n0.3,60\n");
    write_text(folder.path / "tau.csv", "wavelength_um,transmittance\n0.3,0.6\n50,0.6\n");
    const auto material = [&](const char* lines) {
        return read(std::string("like = \"asphalt\"\n") + lines, library(), folder.path);
    };
    // Kirchhoff: an opaque surface sends back what it does not absorb.
    for (const char* lines : {"reflectance = \"rho.csv\"\n", "reflectance = \"eps.csv\"\n",
                              "reflectance = \"cent.csv\"\n"}) {
        CAPTURE(lines);
        const Material m = material(lines);
        CHECK(m.reflectance.at(10.0) == Approx(0.6));
        CHECK(m.thermal.emissivity == Approx(0.4));
    }
    CHECK_THROWS_WITH(material("reflectance = \"tau.csv\"\n"),
                      Catch::Contains("another quantity, expected reflectance"));
    CHECK_THROWS_WITH(material("transmittance = \"eps.csv\"\n"),
                      Catch::Contains("another quantity, expected transmittance"));
}

TEST_CASE("a spectrum that ends before thermal wavelengths is reported, one in nanometres refused",
          "[materials][like][own_keys][spectrum]") {
    const ScratchFolder folder("short");
    write_text(folder.path / "asd.csv", "wavelength_um,value\n0.35,0.2\n2.5,0.3\n");
    write_text(folder.path / "nm.csv", "wavelength_um,value\n350,0.2\n2500,0.3\n");
    write_text(folder.path / "heat.csv", "wavelength_um,value\n3.0,0.05\n14.0,0.05\n");
    write_text(folder.path / "whole.csv", "wavelength_um,value\n0.3,0.2\n14.0,0.05\n");
    const std::vector<Band> thermal{flat_band("8-12", 8.0, 12.0)};
    const auto notes = [&](const std::string& lines, const std::vector<Band>& bands = {}) {
        std::string all;
        const Material m = read("like = \"asphalt\"\n" + lines, library(), folder.path);
        for (const std::string& note : spectrum_notes(m, bands)) all += note + "\n";
        return all;
    };
    const std::string asd = "reflectance = \"asd.csv\"\n";
    CHECK_THAT(notes(asd), Catch::Contains("spectra cover 0.35 to 2.5 µm") &&
                               Catch::Contains("emissivity 0.7 is estimated"));
    CHECK_THAT(notes(asd), !Catch::Contains("albedo"));
    CHECK(notes(asd + "emissivity = 0.95\n").empty());
    CHECK_THAT(notes(asd + "emissivity = 0.95\n", thermal), Catch::Contains("affects band 8-12"));
    CHECK_THAT(notes("reflectance = \"heat.csv\"\n"),
               Catch::Contains("albedo 0.05 is estimated") && !Catch::Contains("emissivity"));
    CHECK(notes("reflectance = \"whole.csv\"\n", thermal).empty());
    CHECK_THROWS_WITH(notes("reflectance = \"nm.csv\"\n"),
                      Catch::Contains("350 to 2500 µm") && Catch::Contains("seem to be in nm"));
    for (const std::string& name : library().names()) {
        CAPTURE(name);
        CHECK(spectrum_notes(library()[library().find(name)], thermal).empty());
    }
}
