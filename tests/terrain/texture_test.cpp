#include "terrain/texture/texture.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/texture/texture_file.hpp"
#include "terrain/texture/texture_levels.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// Texels of a metre, the picture's lower left corner at the origin.
RasterTexture::Layout upright(int columns, int rows, std::vector<float> value) {
    RasterTexture::Layout layout{.columns = columns, .rows = rows, .value = std::move(value)};
    for (Eigen::Vector2d& term : layout.to_texel) term.setZero();
    layout.to_texel[0] = {0.0, double(rows)};
    layout.to_texel[1] = {1.0, 0.0};
    layout.to_texel[2] = {0.0, -1.0};
    return layout;
}

/// Texels of 0 and 1, n each way.
std::vector<float> checkerboard(int n) {
    std::vector<float> value;
    for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) value.push_back(float((r + c) % 2));
    }
    return value;
}

/// A flat square of so many metres, in squares of two triangles, facing up.
FacetSet square(double side, int cells) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const auto n = static_cast<std::uint32_t>(cells + 1);
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) vertex.emplace_back(i * side / cells, j * side / cells, 0);
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
        for (std::uint32_t i = 0; i + 1 < n; ++i) {
            const std::uint32_t a = j * n + i;
            triangle.push_back({a, a + 1, a + n + 1});
            triangle.push_back({a, a + n + 1, a + n});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
    return facets;
}

TextureLevels mixed(const FacetSet& facets, Texture texture) {
    Skin skin{.texture = std::make_shared<const Texture>(std::move(texture)),
              .material = {MaterialId{0}, MaterialId{1}}};
    return split_by_texture(facets, {skin}, std::vector<std::uint16_t>(facets.size(), 0));
}

}  // namespace

TEST_CASE("a raster is looked up where it lies", "[terrain][texture]") {
    //  1 2 3
    //  4 5 6
    auto layout = upright(3, 2, {1, 2, 3, 4, 5, 6});
    layout.nearest = true;
    const RasterTexture nearest(layout);
    CHECK(nearest.at(0.1, 1.9) == 1.0);
    CHECK(nearest.at(2.9, 1.1) == 3.0);
    CHECK(nearest.at(0.1, 0.1) == 4.0);
    CHECK(std::isnan(nearest.at(-0.1, 0.5)));
    CHECK(std::isnan(nearest.at(1.0, 2.1)));
    CHECK(nearest.texel() == Approx(1.0));

    layout.nearest = false;
    const RasterTexture linear(layout);
    CHECK(linear.at(0.5, 1.5) == 1.0);
    CHECK(linear.at(1.0, 1.5) == Approx(1.5));
    CHECK(linear.at(1.0, 1.0) == Approx(3.0));  // in the middle of 1, 2, 4 and 5
    CHECK(linear.at(0.0, 2.0) == 1.0);          // no further than the outermost middles

    layout.repeat = true;
    const RasterTexture again(layout);
    CHECK(again.at(0.5 + 30.0, 1.5 - 20.0) == Approx(1.0));
    CHECK(again.at(3.0, 1.5) == Approx(2.0));  // between the 3 and the next 1

    layout.value[0] = std::numeric_limits<float>::quiet_NaN();
    const RasterTexture holed(layout);
    CHECK(std::isnan(holed.at(0.5, 1.5)));
    CHECK(holed.at(1.0, 1.5) == 2.0);
}

TEST_CASE("texels finer than the samples are averaged", "[terrain][texture]") {
    auto layout = upright(64, 64, checkerboard(64));
    layout.nearest = layout.repeat = true;
    const RasterTexture board(layout);
    CHECK(board.at(10.5, 10.5) != board.at(11.5, 10.5));
    for (const double spacing : {1.5, 3.0, 20.0, 1e5}) {
        CHECK(board.at(10.5, 10.5, spacing) == 0.5);
        CHECK(board.at(-411.2, 97.3, spacing) == 0.5);
    }
}

TEST_CASE("a texture's plane follows its object and stands upright on walls",
          "[terrain][texture]") {
    const Eigen::Vector3f up(0, 0, 1), south(0, -1, 0), east(1, 0, 0);
    const TextureFrame scene;
    CHECK((texture_place(scene, {3, 4, 5}, up) - Eigen::Vector2d(3, 4)).norm() < 1e-12);
    // Looked at from the south, right is east; from the east, right is north.
    CHECK((texture_place(scene, {3, 4, 5}, south) - Eigen::Vector2d(3, 5)).norm() < 1e-12);
    CHECK((texture_place(scene, {3, 4, 5}, east) - Eigen::Vector2d(4, 5)).norm() < 1e-12);
    // An object that looks east has its own north there and its own east in the south.
    const TextureFrame turned{.origin = {10, 20, 0}, .heading = M_PI / 2.0};
    CHECK((texture_place(turned, {12, 20, 0}, up) - Eigen::Vector2d(0, 2)).norm() < 1e-12);
    CHECK((texture_place(turned, {10, 17, 0}, up) - Eigen::Vector2d(3, 0)).norm() < 1e-12);
}

TEST_CASE("facets are solved once for each level that occurs on them",
          "[terrain][texture_levels]") {
    auto layout = upright(8, 8, checkerboard(8));
    layout.nearest = true;
    SECTION("a texel and more a facet: one of the two, no copies") {
        const FacetSet facets = square(8.0, 8);
        const TextureLevels p = mixed(facets, RasterTexture(layout));
        CHECK(p.facets.size() == facets.size());
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const auto x = int(facets.centroid[f].x()), y = int(facets.centroid[f].y());
            CHECK(index(p.facets.material[f]) == std::size_t((x + 7 - y) % 2));
        }
    }
    SECTION("facets that hold many texels: both, by their shares") {
        const FacetSet facets = square(8.0, 1);
        const TextureLevels p = mixed(facets, RasterTexture(layout));
        REQUIRE(p.facets.size() == 4);
        for (std::size_t f = 0; f < 4; ++f) {
            // The board's diagonal is of one colour: a triangle is 0.5 and half a diagonal of it.
            CHECK(p.share[f] == Approx(0.5).margin(0.07));
            CHECK(p.facets.area[f] == Approx(32.0 * p.share[f]));
        }
        CHECK(p.share[0] + p.share[2] == Approx(1.0));
        CHECK(p.origin == std::vector<std::uint32_t>{0, 1, 0, 1});
        const Blend dark = p.at(FacetId{0}, {6.5, 0.5, 0.0}),
                    light = p.at(FacetId{0}, {5.5, 0.5, 0});
        CHECK(dark.first == SurfaceId{0});
        CHECK(dark.second == SurfaceId{2});
        CHECK(std::abs(dark.second_share - light.second_share) == 1.0f);
    }
}

TEST_CASE("copies see what their place sees, and are seen by their shares",
          "[terrain][texture_levels]") {
    const FacetSet facets = square(12.0, 3);
    const TextureLevels p =
        mixed(facets, ClutterTexture{0.5, 0.15, Clutter({.length = 1.0, .seed = 4})});
    REQUIRE(p.facets.size() == 2 * facets.size());
    FacetViews solid;
    solid.others.row = {0};
    for (std::size_t f = 0; f < facets.size(); ++f) {
        solid.sky.push_back(0.4f + 0.01f * float(f));
        solid.below.push_back(0.1f);
        float rest = 0.9f - solid.sky[f];
        for (std::size_t g = 0; g < facets.size(); g += 5) {
            if (g == f) continue;
            solid.others.facet.push_back(std::uint32_t(g));
            solid.others.factor.push_back(0.5f * rest);
            rest *= 0.5f;
        }
        solid.others.row.push_back(std::uint32_t(solid.others.facet.size()));
    }
    const FacetViews all = for_all_levels(p, solid);
    REQUIRE(all.others.row.size() == p.facets.size() + 1);
    const auto sum = [](const ViewFactors& e, std::size_t f) {
        return std::accumulate(e.factor.begin() + e.row[f], e.factor.begin() + e.row[f + 1], 0.0);
    };
    for (std::size_t f = 0; f < p.facets.size(); ++f) {
        CHECK(all.sky[f] == solid.sky[p.origin[f]]);
        CHECK(sum(all.others, f) == Approx(sum(solid.others, p.origin[f])).epsilon(1e-6));
        for (std::uint32_t k = all.others.row[f] + 1; k < all.others.row[f + 1]; ++k) {
            CHECK(all.others.facet[k - 1] < all.others.facet[k]);
        }
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
        CHECK(p.share[f] + p.share[f + facets.size()] == Approx(1.0));
    }
}

TEST_CASE("a georeferenced picture lies where its CRS says", "[terrain][texture]") {
    const ScratchFolder folder("texture");
    Dem dem;
    dem.columns = 60;
    dem.rows = 40;
    const std::string crs = GENERATE("EPSG:32616", "EPSG:4326");
    dem.crs_wkt = crs;
    dem.transform = crs == "EPSG:4326"
                        ? std::array<double, 6>{-84.25, 2e-3, 0.0, 36.36, 0.0, -2e-3}
                        : std::array<double, 6>{746000.0, 150.0, 0.0, 4026000.0, 0.0, -150.0};
    dem.height.resize(60 * 40);
    std::iota(dem.height.begin(), dem.height.end(), 0.0f);
    write_geotiff(folder.path / "t.tif", dem, {{"value", dem.height}});

    const TextureImage image = read_texture_image(folder.path / "t.tif");
    REQUIRE(image.georeferenced);
    CHECK(image.columns == 60);
    CHECK(image.value == dem.height);
    const Site site{36.32, -84.203333, 300.0};
    double worst = 1.0;
    const auto layout = texels_from_site(image, site, 4000.0, &worst);
    CHECK(worst < 1e-3);
    // Against each place's own way through PROJ (terrain/raster/dem.hpp counts from texels'
    // middles).
    for (const Eigen::Vector2d& at :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(-3777, 1234), Eigen::Vector2d(2500, -3900)}) {
        const Geodetic place = to_geodetic(site, {at.x(), at.y(), 0.0});
        const Eigen::Vector2d post = raster_places(dem, {&place, 1}).front();
        const Eigen::Vector2d texel = layout[0] + at.x() * layout[1] + at.y() * layout[2] +
                                      at.x() * at.x() * layout[3] + at.x() * at.y() * layout[4] +
                                      at.y() * at.y() * layout[5];
        CAPTURE(crs, at.transpose());
        CHECK((texel - post - Eigen::Vector2d(0.5, 0.5)).norm() < 2e-3);
    }
}

TEST_CASE("pictures that cannot be read are refused in a line", "[terrain][texture]") {
    const ScratchFolder folder("texture");
    const auto refusal = [&](const std::string& name, int channel = 1) -> std::string {
        try {
            read_texture_image(folder.path / name, channel);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(refusal("none.png").find("the file does not exist") != std::string::npos);
    write_text(folder.path / "broken.png", "PNG but not really");
    CHECK(refusal("broken.png").find("cannot be read") != std::string::npos);
    write_text(folder.path / "grid.asc",
               "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n1 0\n");
    CHECK(refusal("grid.asc") == "accepted");
    CHECK_FALSE(read_texture_image(folder.path / "grid.asc").georeferenced);  // no CRS
    CHECK(refusal("grid.asc", 2).find("has 1 channel, expected at least 2") != std::string::npos);
}
