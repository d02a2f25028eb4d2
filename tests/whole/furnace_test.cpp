#include <catch2/catch.hpp>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/radiation/planck.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "tests/support/isothermal.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

double worst_deviation(double temperature, const Atmosphere& atmosphere, bool terms) {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const MaterialLibrary materials = testing::materials(temperature);
    const FacetViews sky = facet_views(facets, scene);
    const std::vector<float> temperatures(facets.size(), static_cast<float>(temperature));
    const Observer observer = testing::hilly_observer();
    const View view = cast_view(scene, facets, observer);
    const std::vector<Band> bands = {flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                                     flat_band("8-12", 8.0, 12.0, bin_edges_um())};
    const Frame frame = render(view, observer, bands,
                               {.facets = facets,
                                .views = sky,
                                .materials = materials,
                                .atmosphere = atmosphere,
                                .temperature = temperatures,
                                .ground_height_km = 0.3},
                               {.terms = terms});
    double worst = 0.0;
    for (const Band& band : bands) {
        const double black = band_radiance(band, temperature);
        for (const float radiance : frame["radiance." + band.name].pixel) {
            worst = std::max(worst, std::abs(double{radiance} / black - 1.0));
        }
        for (const float apparent : frame["apparent_temperature." + band.name].pixel) {
            worst = std::max(worst, std::abs(double{apparent} / temperature - 1.0));
        }
    }
    return worst;
}

}  // namespace

// Kirchhoff: inside an isothermal enclosure every surface, the air and the sky send out the black
// body's radiance, whatever their emissivities. Tolerance: single precision of the sums.
TEST_CASE("an isothermal enclosure looks black, whatever its emissivity",
          "[render][furnace][by_degenerate]") {
    const double temperature = GENERATE(220.0, 300.0, 345.0);
    const bool terms = GENERATE(false, true);
    const std::string aerosol = GENERATE("none", "rural");
    const BandModel air{.profile = isothermal(afgl_profile("MLS"), temperature),
                        .aerosol = aerosol,
                        .visibility_km = 5.0,
                        .space_temperature = temperature};
    CAPTURE(temperature, terms, aerosol);
    const double worst = worst_deviation(temperature, air, terms);
    CAPTURE(worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("an isothermal enclosure without air looks black", "[render][furnace][by_degenerate]") {
    const double worst = worst_deviation(300.0, Vacuum{.space_temperature = 300.0}, false);
    CAPTURE(worst);
    CHECK(worst < 1e-6);
}
