#include <catch2/catch.hpp>
#include <optional>

#include "materials/radiation/planck.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

/// An upright black wall to the north, its western half at one temperature, the eastern at another;
/// without `east`, sky.
double apparent_of_a_pixel(float west, std::optional<float> east, double space, const Band& band) {
    FacetSet facets;
    std::vector<float> temperature;
    const std::vector<std::array<std::uint32_t, 3>> square = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<MaterialId> black(2, MaterialId{0});
    const auto add = [&](double from, double to, float kelvins) {
        append_facets(facets,
                      std::vector<Eigen::Vector3d>{
                          {from, 50, -30}, {to, 50, -30}, {to, 50, 30}, {from, 50, 30}},
                      square, black, ObjectId{0});
        temperature.resize(facets.size(), kelvins);
    };
    add(-30.0, 0.0, west);
    if (east) add(0.0, 30.0, *east);
    const RayScene scene(facets);
    const MaterialLibrary materials({testing::material("black", flat_spectrum(0.0))});
    const FacetViews sky = facet_views(facets, scene);
    const Atmosphere air = Vacuum{.space_temperature = space};
    Observer observer;
    observer.horizontal_fov_deg = 1.0;
    observer.width = observer.height = 1;
    const View view = cast_view(scene, facets, observer, {.samples = 64});
    const Frame frame = render(view, observer, {&band, 1},
                               {.facets = facets,
                                .views = sky,
                                .materials = materials,
                                .atmosphere = air,
                                .temperature = temperature});
    return double{frame["apparent_temperature." + band.name].pixel[0]};
}

}  // namespace

// 350 K and 290 K side by side in 3-5 µm: the mean radiance is that of 330.5 K, and not of 320 K.
// 330.47 K by band radiances to 40 digits, inverted (5.209 W m⁻² sr⁻¹).
TEST_CASE("a pixel averages radiance, never temperature", "[render][averaging]") {
    const Band band = flat_band("3-5", 3.0, 5.0);
    const double half = apparent_of_a_pixel(350.0f, 290.0f, 3.0, band);
    const double mean = 0.5 * (band_radiance(band, 350.0) + band_radiance(band, 290.0));
    CHECK(half == Approx(brightness_temperature(band, mean)).margin(2e-3));
    CHECK(half - 320.0 == Approx(10.5).margin(0.1));
    const Band lwir = flat_band("8-12", 8.0, 12.0);
    // In 8-12 µm less: the mean of 350 and 290 K there is that of 323.1 K.
    CHECK(apparent_of_a_pixel(350.0f, 290.0f, 3.0, lwir) - 320.0 < 5.0);
    CHECK(apparent_of_a_pixel(350.0f, 290.0f, 3.0, lwir) - 320.0 > 2.0);
}

// The radiometry tables' 0.95 L(300) + 0.05 L(250) of 8-12 µm is 298.080576445 K; here half of a
// pixel is wall and half a sky of 250 K.
TEST_CASE("sky and objects share a pixel by radiance", "[render][averaging]") {
    const Band band = flat_band("8-12", 8.0, 12.0);
    const double half = apparent_of_a_pixel(300.0f, std::nullopt, 250.0, band);
    // 0.5 (38.5004239333 + 14.5593009754) W m⁻² sr⁻¹, inverted.
    CHECK(half ==
          Approx(brightness_temperature(band, 0.5 * (38.5004239333 + 14.5593009754))).margin(2e-3));
    CHECK(brightness_temperature(band, 37.3033677855) == Approx(298.080576445).margin(1e-6));
}
