#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/data_folder.hpp"
#include "materials/base/document.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"

using namespace diurna;

// Emissivity by angle of metals and dielectrics, by n and k or by the index that a reflectance
// upright represents.

namespace {

Material metal(double n, double k, double reflectance) {
    Material material;
    material.reflectance = flat_spectrum(reflectance);
    material.finish = Glossy{
        .roughness = 0.0, .metal = true, .index = flat_spectrum(n), .extinction = flat_spectrum(k)};
    return material;
}

double emissivity(const Material& material, double um, double angle_deg) {
    return directional_optics(material, um, std::cos(radians(angle_deg))).emissivity;
}

Material read(const std::string& finish, double emissivity) {
    const Document document = Document::from_text(
        "[material]\nname = \"own\"\nalbedo = 0.2\nemissivity = " + std::to_string(emissivity) +
            "\nroughness_length_m = 0.01\nlayers = [{ thickness_m = 0.1, conductivity_W_mK = 1.0, "
            "density_kg_m3 = 2000.0, heat_capacity_J_kgK = 800.0 }]\nfinish = " +
            finish + "\n",
        (data_folder() / "column.toml").string());
    const Material material =
        read_material(document.root().required_section("material", ""), default_material_library());
    document.finish();
    return material;
}

}  // namespace

// Aluminium at 10 µm, n = 25.3, k = 89.8 (Rakić 1995), by the first-order law of good conductors
// (Modest, Radiative Heat Transfer, 3.6): 1 − ρ = (4 n / (n² + k²)) (cosθ + 1 / cosθ) / 2.
TEST_CASE("a metal emits to the side as Fresnel's formula says",
          "[materials][finish][by_comparison]") {
    const double n = 25.3, k = 89.8;
    const Material sheet = metal(n, k, fresnel(laboratory_cosine, {n, k}));
    for (const double angle : {0.0, 30.0, 60.0, 75.0}) {
        const double c = std::cos(radians(angle));
        CAPTURE(angle);
        CHECK(emissivity(sheet, 10.0, angle) == Approx(1.0 - fresnel(c, {n, k})).epsilon(1e-9));
        CHECK(emissivity(sheet, 10.0, angle) ==
              Approx(4.0 * n / (n * n + k * k) * 0.5 * (c + 1.0 / c)).epsilon(0.03));
    }
    // It comes to naught at grazing angles, most of it just before.
    CHECK(emissivity(sheet, 10.0, 88.0) > 4.0 * emissivity(sheet, 10.0, 0.0));
    CHECK(emissivity(sheet, 10.0, 89.99) < emissivity(sheet, 10.0, 88.0));
}

// The same law over the hemisphere: ε_h / ε_n = 4/3 as |n| grows (Jakob 1949).
TEST_CASE("metals emit four thirds over the hemisphere of what they do upright",
          "[materials][finish]") {
    const Material sheet = metal(400.0, 400.0, fresnel(laboratory_cosine, {400.0, 400.0}));
    CHECK(hemispherical_optics(sheet, 10.0).emissivity / emissivity(sheet, 10.0, 0.0) ==
          Approx(4.0 / 3.0).epsilon(0.02));
    // Oxide on a dull one takes the same share of what the metal sends back at every angle.
    const Material dull = metal(25.3, 89.8, 0.72);
    const double held = 0.72 / fresnel(laboratory_cosine, {25.3, 89.8});
    CHECK(emissivity(dull, 10.0, 10.0) == Approx(0.28).epsilon(1e-9));
    CHECK(1.0 - emissivity(dull, 10.0, 80.0) ==
          Approx(held * fresnel(std::cos(radians(80.0)), {25.3, 89.8})).epsilon(1e-9));
    // Of one brighter than its index, less is absorbed everywhere.
    const Material bright = metal(25.3, 89.8, 0.995);
    CHECK(emissivity(bright, 10.0, 10.0) == Approx(0.005).epsilon(1e-9));
    CHECK(emissivity(bright, 10.0, 80.0) < 1.0);
    for (const double angle : {0.0, 45.0, 70.0, 80.0, 85.0, 89.0}) {
        CHECK(emissivity(dull, 10.0, angle) <= 1.0);
        CHECK(emissivity(dull, 10.0, angle) >= 0.0);
    }
}

/// Hemispherical emissivity of a smooth dielectric (Dunkle 1965; Modest, 3.80).
double dunkle(double n) {
    const double n2 = n * n, n4 = n2 * n2;
    return 0.5 - (3 * n + 1) * (n - 1) / (6 * (n + 1) * (n + 1)) -
           n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) +
           2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) -
           8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

TEST_CASE("a dielectric of an effective index emits over the hemisphere as Dunkle says",
          "[materials][finish][by_comparison]") {
    CHECK(dunkle(1.5) == Approx(0.908).margin(1e-3));  // Modest, figure 3.18
    for (const double n : {1.3, 1.5, 2.0}) {
        const double upright = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
        const Material own =
            read("{ kind = \"gloss\", roughness = 0.0, index = 1.5, effective_index = true }",
                 1.0 - upright);
        CAPTURE(n);
        CHECK(std::get<Glossy>(own.finish).index.at(10.0) == Approx(n).epsilon(2e-3));
        CHECK(std::get<Glossy>(own.finish).index.at(0.5) == Approx(1.5));
        CHECK(hemispherical_optics(own, 10.0).emissivity == Approx(dunkle(n)).margin(2e-3));
        CHECK(emissivity(own, 10.0, 60.0) == Approx(1.0 - fresnel(0.5, n)).margin(1e-3));
    }
}

// Hagen & Rubens, n = k: ε_n = 0.1 wants n = k = 18.97, ρ = (2n² − 2n + 1) / (2n² + 2n + 1).
TEST_CASE("a metal of an effective index follows Hagen and Rubens",
          "[materials][finish][by_comparison]") {
    const Material own = read("{ kind = \"metal\", roughness = 0.0, effective_index = true }", 0.1);
    const double n = std::get<Glossy>(own.finish).index.at(10.0);
    CHECK((2 * n * n - 2 * n + 1) / (2 * n * n + 2 * n + 1) == Approx(0.9).margin(1e-3));
    CHECK(std::get<Glossy>(own.finish).extinction.at(10.0) == Approx(n));
    CHECK(emissivity(own, 10.0, 70.0) ==
          Approx(1.0 - fresnel(std::cos(radians(70.0)), {n, n})).margin(2e-3));
}

TEST_CASE("the library's metals and ice look different from the side", "[materials][finish]") {
    const MaterialLibrary library = default_material_library();
    const auto of = [&](const char* name) -> const Material& {
        return library[library.find(name)];
    };
    CHECK(emissivity(of("aluminium_polished"), 10.0, 80.0) >
          2.0 * emissivity(of("aluminium_polished"), 10.0, 0.0));
    CHECK(emissivity(of("ice"), 11.0, 80.0) < 0.85 * emissivity(of("ice"), 11.0, 0.0));
    CHECK(of("aluminium").thermal.emissivity >
          1.0 - of("aluminium").reflectance.at(10.0));  // over the hemisphere more than upright
}
