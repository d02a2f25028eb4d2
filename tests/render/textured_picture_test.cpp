#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/isothermal.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

Texture board(double texel, bool nearest = true) {
    RasterTexture::Layout layout{.columns = 2,
                                 .rows = 2,
                                 .value = {0.0f, 1.0f, 1.0f, 0.0f},
                                 .nearest = nearest,
                                 .repeat = true};
    for (Eigen::Vector2d& term : layout.to_texel) term.setZero();
    layout.to_texel[1] = {1.0 / texel, 0.0};
    layout.to_texel[2] = {0.0, -1.0 / texel};
    return RasterTexture(layout);
}

Texture clutter(double length) {
    return ClutterTexture{0.5, 0.15, Clutter({.length = length, .seed = 9})};
}

Skin between(testing::Kind a, testing::Kind b, Texture texture) {
    return {.texture = std::make_shared<const Texture>(std::move(texture)),
            .material = {MaterialId{a}, MaterialId{b}}};
}

/// A scene, textured or not, at temperatures by material.
struct Scenery {
    const FacetSet& solid;
    TextureLevels texture_levels;
    MaterialLibrary materials;
    Atmosphere air;
    RayScene rays{solid};
    FacetViews solid_sky = facet_views(solid, rays);

    const FacetSet& facets() const {
        return texture_levels.empty() ? solid : texture_levels.facets;
    }
    Frame look(const Observer& observer, const Band& band, std::array<float, 4> kelvins,
               int samples = 16, double sun_zenith_deg = 180.0) const {
        const ViewOptions options{.samples = samples, .texture_levels = &texture_levels};
        View view = cast_view(rays, facets(), observer, options);
        const PlumeScene none({});
        const SecondaryRays secondary_rays =
            follow_rays(view, {rays, facets(), materials, none}, observer, options);
        const FacetViews sky =
            texture_levels.empty() ? solid_sky : for_all_levels(texture_levels, solid_sky);
        std::vector<float> temperature, lit;
        for (const MaterialId id : facets().material) temperature.push_back(kelvins[index(id)]);
        const double zenith = sun_zenith_deg * std::numbers::pi / 180.0;
        if (sun_zenith_deg < 90.0) lit.assign(facets().size(), 1.0f);
        return render(view, observer, {&band, 1},
                      {.facets = facets(),
                       .views = sky,
                       .materials = materials,
                       .atmosphere = air,
                       .temperature = temperature,
                       .sun_fraction = lit,
                       .to_sun = {std::sin(zenith), 0.0, std::cos(zenith)},
                       .sun_zenith_deg = sun_zenith_deg,
                       .ground_height_km = 0.3},
                      {.secondary_rays = &secondary_rays});
    }
};

/// A flat square of 400 m in 200 triangles, all of one material.
FacetSet plain(testing::Kind kind) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    for (int j = 0; j <= 10; ++j) {
        for (int i = 0; i <= 10; ++i) vertex.emplace_back(40.0 * i - 200.0, 40.0 * j - 200.0, 0.0);
    }
    for (std::uint32_t j = 0; j < 10; ++j) {
        for (std::uint32_t i = 0; i < 10; ++i) {
            const std::uint32_t a = 11 * j + i;
            triangle.push_back({a, a + 1, a + 12});
            triangle.push_back({a, a + 12, a + 11});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle,
                  std::vector<MaterialId>(triangle.size(), MaterialId{kind}), ObjectId{0});
    return facets;
}

Observer above(double height, int size) {
    Observer observer;
    observer.position = {0.0, 0.0, height};
    observer.elevation_deg = -90.0;
    observer.horizontal_fov_deg = 3.0;
    observer.width = observer.height = size;
    return observer;
}

double mean(const std::vector<float>& pixels) {
    double sum = 0.0;
    for (const float v : pixels) sum += double{v} / double(pixels.size());
    return sum;
}

}  // namespace

// As furnace_test, with every facet a texture_levels: hills of soil and paint, a box whose walls
// are panes to half their area, seen through.
TEST_CASE("an isothermal enclosure looks black, whatever its textures",
          "[render][texture][by_degenerate]") {
    const double kelvins = 300.0;
    std::vector<Material> all;
    const MaterialLibrary base = testing::materials(kelvins);
    for (std::uint16_t m = 0; m < 4; ++m) all.push_back(base[MaterialId{m}]);
    all[testing::glass].see_through = true;
    const FacetSet facets = testing::hilly_world();
    std::vector<std::uint16_t> skin;
    for (const ObjectId object : facets.object) skin.push_back(object == ObjectId{0} ? 0 : 1);
    const Scenery scenery{
        .solid = facets,
        .texture_levels = split_by_texture(facets,
                                           {between(testing::soil, testing::paint, clutter(30.0)),
                                            between(testing::metal, testing::glass, clutter(3.0))},
                                           skin),
        .materials = MaterialLibrary(all),
        .air = BandModel{.profile = isothermal(afgl_profile("MLS"), kelvins),
                         .aerosol = "rural",
                         .visibility_km = 5.0,
                         .space_temperature = kelvins}};
    REQUIRE(scenery.facets().size() == 2 * facets.size());
    for (const Band& band : {flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                             flat_band("8-12", 8.0, 12.0, bin_edges_um())}) {
        const float t = float(kelvins);
        const Frame frame = scenery.look(testing::hilly_observer(), band, {t, t, t, t});
        const double black = band_radiance(band, kelvins);
        double worst = 0.0;
        for (const float radiance : frame["radiance." + band.name].pixel) {
            worst = std::max(worst, std::abs(double{radiance} / black - 1.0));
        }
        CAPTURE(band.name, worst);
        CHECK(worst < 1e-6);
        for (const float truth : frame["temperature"].pixel) {
            if (!std::isnan(truth)) REQUIRE(truth == Approx(kelvins).epsilon(1e-6));
        }
    }
}

// Two materials in equal parts, finer than the samples: radiance is the mean of both materials' own
// side by side, in heat and in sunlight, and the apparent temperature is not the mean of theirs.
TEST_CASE("a chessboard seen from afar is the mean radiance of both its materials",
          "[render][texture]") {
    const bool day = GENERATE(false, true);
    const Band band = day ? flat_band("1.5-1.8", 1.5, 1.8, bin_edges_um())
                          : flat_band("3-5", 3.0, 5.0, bin_edges_um());
    FacetSet facets = plain(testing::soil);
    std::vector<std::uint16_t> skin;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const float x = facets.centroid[f].x();
        if (x > 40.0f) facets.material[f] = MaterialId{testing::paint};
        skin.push_back(std::abs(x) < 40.0f ? 0 : no_skin);
    }
    const Scenery scenery{.solid = facets,
                          .texture_levels = split_by_texture(
                              facets, {between(testing::soil, testing::paint, board(0.5))}, skin),
                          .materials = testing::materials(300.0),
                          .air = Vacuum{.space_temperature = 3.0}};
    Observer observer = above(2000.0, 24);
    observer.projection = Projection::orthographic;
    observer.picture_width = 240.0;  // samples 2.5 m apart
    const Frame frame =
        scenery.look(observer, band, {350.0f, 300.0f, 300.0f, 290.0f}, 16, day ? 35.0 : 180.0);
    const auto& radiance = frame["radiance." + band.name].pixel;
    const auto& apparent = frame["apparent_temperature." + band.name].pixel;
    for (std::size_t row = 1; row < 23; ++row) {
        const auto at = [&](std::size_t column) { return row * 24 + column; };
        for (std::size_t column = 9; column < 15; ++column) {
            const double half =
                0.5 * (double{radiance[at(column - 8)]} + double{radiance[at(column + 8)]});
            REQUIRE(double{radiance[at(column)]} == Approx(half).epsilon(1e-6));
        }
        if (!day) CHECK(apparent[at(12)] > 0.5f * (apparent[at(2)] + apparent[at(22)]) + 5.0f);
    }
}

// From near, each pixel within a texel is of one material; all together are half of each.
TEST_CASE("a chessboard seen from near shows its texels, whatever the facets",
          "[render][texture]") {
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const FacetSet facets = plain(testing::soil);
    const Scenery scenery{.solid = facets,
                          .texture_levels = split_by_texture(
                              facets, {between(testing::soil, testing::paint, board(1.0))},
                              std::vector<std::uint16_t>(facets.size(), 0)),
                          .materials = testing::materials(300.0),
                          .air = Vacuum{.space_temperature = 3.0}};
    // 80 pixels of 0.1 m across 8 texels of 1 m: each holds 10 x 10 whole pixels.
    Observer observer = above(50.0, 80);
    observer.projection = Projection::orthographic;
    observer.picture_width = 8.0;
    const Frame frame = scenery.look(observer, band, {320.0f, 300.0f, 300.0f, 290.0f});
    const auto& pixel = frame["radiance.8-12"].pixel;
    const auto& truth = frame["temperature"].pixel;
    const auto& material = frame["material"].pixel;
    std::size_t odd = 0;
    for (std::size_t p = 0; p < pixel.size(); ++p) {
        const bool first = (p % 80 / 10 + p / 80 / 10) % 2 == 0;
        odd += truth[p] != (first ? truth[5 * 81] : truth[5 * 81 + 10]);
        odd += std::abs(pixel[p] - (first ? pixel[5 * 81] : pixel[5 * 81 + 10])) > 1e-4f * pixel[p];
    }
    CHECK(odd == 0);
    CHECK(std::abs(truth[5 * 81] - truth[5 * 81 + 10]) == Approx(30.0));
    CHECK(std::abs(material[5 * 81] - material[5 * 81 + 10]) == testing::paint - testing::soil);
}

TEST_CASE("a mixture of a material with itself is that material",
          "[render][texture][by_degenerate]") {
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const FacetSet facets = testing::hilly_world();
    std::vector<std::uint16_t> skin;
    for (const ObjectId o : facets.object) skin.push_back(o == ObjectId{0} ? 0 : no_skin);
    const Atmosphere air = BandModel{.profile = afgl_profile("MLS")};
    const std::array<float, 4> kelvins = {305.0f, 315.0f, 300.0f, 322.0f};
    const Scenery bare{.solid = facets,
                       .texture_levels = TextureLevels{},
                       .materials = testing::materials(295.0),
                       .air = air};
    const Scenery mixed{.solid = facets,
                        .texture_levels = split_by_texture(
                            facets, {between(testing::soil, testing::soil, clutter(5.0))}, skin),
                        .materials = testing::materials(295.0),
                        .air = air};
    const Frame a = bare.look(testing::hilly_observer(), band, kelvins);
    const Frame b = mixed.look(testing::hilly_observer(), band, kelvins);
    const auto &x = a["radiance.8-12"].pixel, &y = b["radiance.8-12"].pixel;
    double worst = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
        worst = std::max(worst, std::abs(double{y[p]} / double{x[p]} - 1.0));
    }
    CAPTURE(worst);
    CHECK(worst < 2e-6);
}

TEST_CASE("textured pictures are the same bytes for any number of threads",
          "[render][texture][by_replication]") {
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const FacetSet facets = testing::hilly_world();
    std::vector<std::vector<float>> pictures;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        const Scenery scenery{.solid = facets,
                              .texture_levels = split_by_texture(
                                  facets, {between(testing::soil, testing::paint, clutter(20.0))},
                                  std::vector<std::uint16_t>(facets.size(), 0)),
                              .materials = testing::materials(300.0),
                              .air = Vacuum{.space_temperature = 3.0}};
        pictures.push_back(scenery
                               .look(testing::hilly_observer(), band,
                                     {320.0f, 300.0f, 300.0f, 290.0f})["radiance.8-12"]
                               .pixel);
    }
    set_thread_count(0);
    CHECK(pictures[0] == pictures[1]);
    CHECK(pictures[0] == pictures[2]);
    CHECK(mean(pictures[0]) > 0.0);
}
