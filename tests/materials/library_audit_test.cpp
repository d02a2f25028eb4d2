#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/library_notes.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

// The library against measured collections and tables of engineering. Where it differs on purpose
// the difference stands here.

namespace {

const MaterialLibrary& library() {
    static const MaterialLibrary loaded = default_material_library();
    return loaded;
}
const Material& material(const std::string& name) { return library()[library().find(name)]; }

/// ∫ s B(300 K) over ∫ B, in a band.
double planck_in(const Spectrum& s, double from_um, double to_um) {
    const Band band = flat_band("", from_um, to_um, s.wavelength_um);
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] * planck(band.node_um[i], 300.0) * s.at(band.node_um[i]);
    }
    return sum / band_radiance(band, 300.0);
}

Spectrum measured(const std::filesystem::path& file) {
    Spectrum s = read_spectrum(file);
    s.wavelength_um.insert(s.wavelength_um.begin(), 0.2);
    s.value.insert(s.value.begin(), s.value.front());
    s.wavelength_um.push_back(100.0);
    s.value.push_back(s.value.back());
    return s;
}

}  // namespace

// Spreads: 0.01 where the library is after that very sample, what samples of a kind differ by where
// it represents the kind, 1 where the library is something else on purpose (its spectrum's head
// says what; the published ranges below hold there).
TEST_CASE("spectra are those of the ECOSTRESS library within the spread of its samples",
          "[materials][audit][by_history]") {
    const auto folder = shared_data("data/spectra/materials");
    if (!folder) return;
    struct Row {
        const char *name, *sample;
        double albedo, mwir, lwir;
    };
    for (const auto& [name, sample, albedo, mwir, lwir] :
         {Row{"grass", "grass_green", 0.01, 0.01, 0.01},
          Row{"dry_grass", "grass_dry", 1.0, 0.01, 0.01},  // blades that shade each other
          Row{"bare_soil", "soil_brown_sandy_loam_alfisol", 0.03, 0.02, 0.02},
          Row{"bare_soil", "soil_brown_silty_loam_aridisol", 0.06, 0.08, 0.02},
          Row{"sandy_soil", "soil_loamy_sand_aridisol", 0.01, 0.01, 0.01},
          Row{"clay_soil", "soil_brown_clay_vertisol", 0.05, 0.01, 0.01},  // recorded too dark
          Row{"asphalt", "asphalt_paving", 0.02, 0.02, 0.02},
          Row{"asphalt", "asphalt_paving_weathered", 0.02, 0.02, 0.02},
          Row{"concrete", "concrete_construction", 0.04, 0.03, 0.04},
          Row{"concrete", "concrete_paving_weathered", 0.04, 0.03, 0.04},
          Row{"brick", "brick_red", 0.01, 0.01, 0.01},
          Row{"glass", "glass_window", 0.04, 0.01, 0.03},  // measured with what lies behind
          Row{"galvanised_steel_oxidised", "steel_galvanised_oxidised_bare", 0.01, 0.01, 0.01},
          Row{"aluminium", "aluminium_roofing", 0.01, 0.01, 0.01},
          Row{"clay_tile", "roof_tile_terracotta", 1.0, 0.02, 0.01},  // a soiled one
          Row{"wood", "wood_pine", 0.01, 0.01, 0.01},
          Row{"sand", "sand_brown_entisol", 1.0, 0.02, 0.02},  // a dark one
          Row{"sand", "sand_gypsum_dune", 1.0, 0.10, 0.03},    // white
          Row{"water", "water_tap", 0.01, 0.01, 0.01}, Row{"ice", "ice", 1.0, 0.02, 0.02},  // clear
          Row{"snow", "snow_fine", 0.06, 0.02, 0.02}, Row{"snow", "snow_coarse", 0.06, 0.02, 0.02},
          // 24 and 178 µm of radius; by asymptotics of 50 and 200
          Row{"snow_fine", "snow_fine", 0.02, 0.01, 0.01},
          Row{"snow_medium", "snow_coarse", 0.03, 0.02, 0.02},
          Row{"conifer", "conifer", 1.0, 0.01, 0.01},
          Row{"broadleaf", "deciduous", 1.0, 0.01, 0.01},  // leaves that shade each other
          Row{"painted_steel", "paint_black_gloss_on_aluminium", 1.0, 0.02, 0.01},
          Row{"green_paint", "paint_olive_2coats_on_pine", 1.0, 0.01, 0.01}}) {
        const Spectrum s = measured(*folder / (std::string(sample) + ".csv"));
        const Spectrum& own = material(name).reflectance;
        CAPTURE(name, sample);
        CHECK(solar_mean(own) == Approx(solar_mean(s)).margin(albedo));
        CHECK(planck_in(own, 3.0, 5.0) == Approx(planck_in(s, 3.0, 5.0)).margin(mwir));
        CHECK(planck_in(own, 8.0, 12.0) == Approx(planck_in(s, 8.0, 12.0)).margin(lwir));
    }
}

// Buettner & Kern 1965, J. Geophys. Res. 70, 1329: 8 to 12 µm, measured in a box outdoors.
TEST_CASE("emissivities in 8-12 µm are those of Buettner and Kern",
          "[materials][audit][by_history]") {
    struct Row {
        const char* name;
        double emissivity, spread;
    };
    for (const auto& [name, emissivity, spread] :
         {Row{"rock", 0.922, 0.015},  // silica sandstone, polished 0.909 to rough 0.935
          Row{"sand", 0.914, 0.02}, Row{"asphalt", 0.959, 0.015}, Row{"concrete", 0.966, 0.03},
          Row{"basalt_cinder", 0.934, 0.04}, Row{"water", 0.993, 0.006}}) {
        CAPTURE(name);
        CHECK(1.0 - planck_in(material(name).reflectance, 8.0, 12.0) ==
              Approx(emissivity).margin(spread));
    }
}

TEST_CASE("absorptance of sunlight is that of engineering's tables",
          "[materials][audit][by_history]") {
    struct Range {
        const char* name;
        double least, most;  // absorptance
    };
    for (const auto& [name, least, most] : {
             Range{"galvanised_steel", 0.79, 0.81},         // Incropera, A.12: weathered 0.80
             Range{"galvanised_steel_bright", 0.64, 0.66},  // clean, new 0.65
             Range{"aluminium_anodised", 0.12, 0.16},       // 0.14
             Range{"aluminium_polished", 0.07, 0.11},       // 0.09
             Range{"aluminium", 0.40, 0.65},                // CIBSE Guide A: dull
             Range{"low_emissivity_paint", 0.30, 0.55},     // aluminium paint
             Range{"rock", 0.54, 0.76},                     // sandstone
             Range{"clay_tile", 0.60, 0.70},                // red tiles, to rounding
             Range{"solar_panel", 0.885, 0.925},            // Santbergen & van Zolingen 2008: 0.905
             Range{"sand", 0.55, 0.65},                     // Sellers 1965: dry sand
             Range{"clay_soil_wet", 0.88, 0.95},  // Oke 1987: soils dark, wet to light, dry
             Range{"sandy_soil_wet", 0.80, 0.90}, Range{"conifer", 0.85, 0.95},
             Range{"broadleaf", 0.80, 0.85}, Range{"crops", 0.75, 0.82}, Range{"ice", 0.58, 0.80},
             Range{"sea_water", 0.90, 0.97},
             Range{"skin", 0.57, 0.70},  // Jacquez 1955: fair skin sends back 0.3 to 0.43
         }) {
        const ThermalSurface& thermal = material(name).thermal;
        CAPTURE(name, thermal.albedo);
        CHECK(1.0 - thermal.albedo - thermal.solar_transmittance >= least - 0.005);
        CHECK(1.0 - thermal.albedo - thermal.solar_transmittance <= most + 0.005);
    }
}

// Near the normal, as tables have them: metals emit more to the side.
TEST_CASE("total emissivity is that of engineering's tables", "[materials][audit][by_history]") {
    struct Row {
        const char* name;
        double emissivity, spread;
    };
    for (const auto& [name, emissivity, spread] :
         {Row{"galvanised_steel", 0.28, 0.01},         // Bramson 1968; Incropera, A.12
          Row{"galvanised_steel_bright", 0.23, 0.01},  // Bramson 1968: burnished
          Row{"aluminium_polished", 0.03, 0.02},       // Incropera, A.12
          Row{"aluminium", 0.06, 0.02},                // FLIR: scratched sheet 0.03 to 0.08
          Row{"aluminium_anodised", 0.84, 0.02},       // Incropera, A.12
          Row{"low_emissivity_paint", 0.40, 0.02}, Row{"rubber", 0.95, 0.01},  // Bramson 1968
          Row{"skin", 0.98, 0.01}, Row{"painted_steel", 0.92, 0.02}}) {
        CAPTURE(name);
        CHECK(1.0 - planck_mean(material(name).reflectance) == Approx(emissivity).margin(spread));
    }
}

TEST_CASE("the ice and aluminium of the library are Fresnel's of their n and k",
          "[materials][audit][by_comparison]") {
    const auto check = [](const char* spectrum, const char* index, double from_um, double margin) {
        const CsvTable table = read_csv(data_folder() / "spectra" / index);
        const Spectrum s = read_spectrum(data_folder() / "spectra" / spectrum);
        const Spectrum n{table.rows.empty() ? std::vector<double>{} : s.wavelength_um, {}};
        Spectrum re, im;
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            re.wavelength_um.push_back(table.number(row, 0));
            re.value.push_back(table.number(row, 1));
            im.value.push_back(table.number(row, 2));
        }
        im.wavelength_um = re.wavelength_um;
        for (std::size_t i = 0; i < s.value.size(); ++i) {
            const double um = s.wavelength_um[i];
            if (um < from_um || um > re.wavelength_um.back()) continue;
            CAPTURE(spectrum, um);
            CHECK(s.value[i] ==
                  Approx(fresnel(laboratory_cosine, {re.at(um), im.at(um)})).margin(margin));
        }
    };
    check("aluminium_polished.csv", "aluminium_refraction.csv", 0.31, 1e-4);
    // Ice beyond 2.9 µm: nothing comes back from inside.
    check("ice.csv", "ice_refraction.csv", 2.9, 1e-3);
}

// Wiscombe & Warren 1980, figure 8 and their text: grains of 1 mm send back about half of what
// fine ones do at 1.03 µm; visible light comes back whatever their size; beyond 1.5 µm little.
TEST_CASE("snow darkens with its grains in the near infrared alone", "[materials][audit]") {
    const Spectrum &fine = material("snow_fine").reflectance,
                   &coarse = material("snow_coarse").reflectance;
    CHECK(fine.at(0.5) > 0.985);
    CHECK(coarse.at(0.5) > 0.96);
    CHECK(fine.at(1.03) == Approx(0.82).margin(0.05));
    CHECK(coarse.at(1.03) == Approx(0.40).margin(0.06));
    CHECK(coarse.at(1.5) < 0.02);
    CHECK(material("snow_medium").thermal.albedo < material("snow_fine").thermal.albedo);
    CHECK(material("snow_coarse").thermal.albedo < material("snow_medium").thermal.albedo);
}

// Lekner & Dorf 1988: at 0.6 µm, where water is clear, p = 1 − (1 − 0.066) / 1.33².
TEST_CASE("wet soil is darker by what water keeps in", "[materials][audit]") {
    for (const auto& [dry, wet] :
         {std::pair{"bare_soil", "wet_soil"}, std::pair{"sandy_soil", "sandy_soil_wet"},
          std::pair{"clay_soil", "clay_soil_wet"}}) {
        const double rho = material(dry).reflectance.at(0.6), p = 1.0 - 0.934 / (1.33 * 1.33);
        const double expected = 0.0204 + (1.0 - 0.0204) * (1.0 - p) * rho / (1.0 - p * rho);
        CAPTURE(dry);
        CHECK(material(wet).reflectance.at(0.6) == Approx(expected).margin(0.003));
    }
}

TEST_CASE("every number of the library has its source", "[materials][audit]") {
    const LibraryNotes notes = library_notes(data_folder() / "library.toml");
    REQUIRE(notes.materials.size() == library().size());
    CHECK(notes.sources.size() > 15);
    for (const MaterialNote& note : notes.materials) {
        CAPTURE(note.name);
        CHECK_FALSE(note.what.empty());
        for (const std::string& line : lines_without_source(note)) {
            CAPTURE(line);
            CHECK(line.empty());
        }
        for (const std::string& file : spectra_of(note)) {
            CAPTURE(file);
            CHECK(head_comment(data_folder() / file).size() >= 1);
        }
    }
}

TEST_CASE("notes of a library are read unchanged", "[materials][audit]") {
    const LibraryNotes notes = library_notes(data_folder() / "library.toml");
    const MaterialNote* brown = notes.find("brown_paint");
    REQUIRE(brown != nullptr);
    CHECK(brown->like == "painted_sheet");
    CHECK(spectra_of(*brown) == std::vector<std::string>{"spectra/brown_paint.csv"});
    CHECK(notes.find("no such") == nullptr);
    CHECK(names_source("fallow ground 0.004 (W93)", "W93"));
    CHECK_FALSE(names_source("W931", "W93"));
    const MaterialNote bare{.name = "x", .what = "", .like = "", .lines = {"albedo = 0.2"}};
    CHECK(lines_without_source(bare).size() == 1);
    const MaterialNote reported{
        .name = "x", .what = "", .like = "", .lines = {"# measured", "albedo = 0.2"}};
    CHECK(lines_without_source(reported).empty());
}
