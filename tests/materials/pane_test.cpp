#include "materials/matter/pane.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/read_library.hpp"

using namespace diurna;

namespace {

const Material& glass() {
    static const MaterialLibrary library = default_material_library();
    return library[library.find("glass")];
}

/// Of one face, across and along the plane of incidence, with Snell's law by angles.
struct Faces {
    double across, along, inside_cosine;
    Faces(double angle_deg, double n) {
        const double a = radians(angle_deg), b = std::asin(std::sin(a) / n);
        across = std::pow(std::sin(a - b) / std::sin(a + b), 2);
        along = std::pow(std::tan(a - b) / std::tan(a + b), 2);
        inside_cosine = std::cos(b);
    }
};

}  // namespace

// Light followed to and fro, face by face. Glass of n = 1.526 at 60 degrees: a face reflects 0.093
// (Duffie & Beckman, Solar Engineering of Thermal Processes, example 5.1.1).
TEST_CASE("light is reflected to and fro between a pane's faces", "[materials][pane]") {
    CHECK(0.5 * (Faces(60.0, 1.526).across + Faces(60.0, 1.526).along) ==
          Approx(0.093).margin(5e-4));
    const double inside = GENERATE(1.0, 0.9, 0.4, 0.0);
    for (const double angle : {1.0, 30.0, 60.0, 80.0}) {
        const Faces faces(angle, 1.526);
        const double way = std::pow(inside, 1.0 / faces.inside_cosine);
        double through = 0.0, back = 0.0;
        for (const double f : {faces.across, faces.along}) {
            back += 0.5 * f;
            double light = 0.5 * (1.0 - f) * way;  // at a face from within: the far one first
            for (int k = 0; k < 200; ++k) {
                (k % 2 == 0 ? through : back) += light * (1.0 - f);
                light *= f * way;
            }
        }
        const PaneOptics pane = pane_optics(std::cos(radians(angle)), 1.526, inside);
        CAPTURE(inside, angle);
        CHECK(pane.transmittance == Approx(through).margin(1e-9));
        CHECK(pane.reflectance == Approx(back).margin(1e-9));
        if (inside == 1.0) CHECK(pane.transmittance + pane.reflectance == Approx(1.0));
    }
}

TEST_CASE("a pane's inside is found from what it lets through", "[materials][pane]") {
    for (const double inside : {0.02, 0.5, 0.97, 1.0}) {
        const PaneOptics upright = pane_optics(1.0, 1.52, inside);
        CHECK(inside_of_pane(upright.transmittance, 1.52) == Approx(inside).epsilon(1e-9));
    }
    CHECK(inside_of_pane(0.0, 1.52) == 0.0);
}

// Clear window glass: both faces 0.08 of visible light; hemispherical emissivity at room
// temperature 0.837 (EN 12898, uncoated soda lime glass); at grazing angles it mirrors all.
TEST_CASE("window glass is smooth on both sides", "[materials][pane]") {
    const auto visible = directional_optics(glass(), 0.55, 1.0);
    CAPTURE(visible.mirrored, visible.transmittance, glass().thermal.emissivity);
    CHECK(visible.mirrored == Approx(0.08).margin(0.005));
    CHECK(visible.diffuse < 0.002);
    CHECK(glass().thermal.emissivity == Approx(0.837).margin(0.01));
    for (const double um : {0.55, 4.0, 10.0}) {
        double before = 0.0;
        for (const double angle : {60.0, 75.0, 85.0, 89.9}) {
            const auto optics = directional_optics(glass(), um, std::cos(radians(angle)));
            CAPTURE(um, angle);
            CHECK(optics.mirrored > before);
            CHECK(optics.emissivity >= 0.0);
            CHECK(optics.emissivity + optics.mirrored + optics.diffuse + optics.transmittance ==
                  Approx(1.0));
            before = optics.mirrored;
        }
        CHECK(before > 0.95);
    }
}
