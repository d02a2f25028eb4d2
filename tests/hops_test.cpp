#include "render/hops.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/error.hpp"
#include "materials/microfacet.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "render/hop_merge.hpp"
#include "render/hop_reference.hpp"
#include "render/hop_shading.hpp"
#include "render/hop_walk.hpp"
#include "terrain/parallel.hpp"
#include "terrain/site.hpp"
#include "terrain/visibility.hpp"
#include "tests/render_scene.hpp"

using namespace diurna;

namespace {

/// A wall to the north, 40 m wide and high, with something in front of it; the eye stands at the
/// origin, the air is none and space is cold.
struct Stage {
    FacetSet facets;
    std::vector<Material> all;
    std::vector<Plume> plumes;
    std::vector<float> temperature, sun;
    Atmosphere air = Vacuum{.space_temperature = 3.0};
    double ground_km = 0.3;
    Eigen::Vector3d to_sun = direction(200.0, 40.0);

    /// An upright rectangle across the line of sight, `north` metres away, that faces south.
    void wall(double north, double half, Material material, float kelvins,
              bool faces_south = true) {
        rectangle({{-half, north, -half},
                   {half, north, -half},
                   {half, north, half},
                   {-half, north, half}},
                  std::move(material), kelvins, faces_south);
    }
    void rectangle(std::vector<Eigen::Vector3d> corner, Material material, float kelvins,
                   bool as_given = true) {
        std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}, {0, 2, 3}};
        if (!as_given) triangle = {{0, 2, 1}, {0, 3, 2}};
        material.name += std::to_string(all.size());  // a library holds a name once
        all.push_back(std::move(material));
        append_facets(facets, corner, triangle,
                      std::vector<MaterialId>(2, MaterialId{std::uint16_t(all.size() - 1)}),
                      ObjectId{0});
        temperature.resize(facets.size(), kelvins);
    }
    void plume(double north, double thickness, double absorption, double kelvins) {
        Plume box{.name = "gas",
                  .vertex = {},
                  .triangle = {},
                  .absorption = flat_spectrum(absorption),
                  .temperature = kelvins};
        for (const double up : {-5.0, 5.0}) {
            for (const auto& [x, y] :
                 {std::pair{-5.0, 0.0}, {5.0, 0.0}, {5.0, thickness}, {-5.0, thickness}}) {
                box.vertex.emplace_back(x, north + y, up);
            }
        }
        box.triangle = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                        {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}, {0, 2, 1}, {0, 3, 2}};
        plumes.push_back(std::move(box));
    }

    struct Seen {
        Hops hops;
        View view;
        std::vector<std::vector<float>> planes;  // (term)
        std::vector<double> reference;           // (every 41st pixel of the hops)
        double at(std::size_t pixel) const {
            double sum = 0.0;
            for (const auto& plane : planes) sum += double{plane[pixel]};
            return sum;
        }
    };
    Observer observer(int size = 5, double fov_deg = 2.0) const {
        Observer eye;
        eye.horizontal_fov_deg = fov_deg;
        eye.width = eye.height = size;
        return eye;
    }
    Seen look(const Observer& eye, const Band& band, int samples = 16,
              bool with_reference = false) {
        const RayScene scene(facets);
        const MaterialLibrary materials(all);
        const SkyView sky = sky_view(facets, scene, {.rays = 64});
        Seen seen;
        seen.view = cast_view(scene, facets, eye, {.samples = samples});
        const PlumeScene volumes(plumes);
        seen.hops =
            follow_rays(seen.view, scene, facets, materials, volumes, eye, {.samples = samples});
        const RadianceInput input{.facets = facets,
                                  .sky_view = sky,
                                  .materials = materials,
                                  .atmosphere = air,
                                  .temperature = temperature,
                                  .sun_fraction = sun,
                                  .to_sun = to_sun,
                                  .sun_zenith_deg = degrees(std::acos(to_sun.z())),
                                  .ground_height_km = ground_km};
        seen.planes.assign(term_count, std::vector<float>(seen.view.pixels(), 0.0f));
        const HopLight light(seen.hops, plumes, seen.view.observer_height, {&band, 1}, input);
        light.add(seen.planes);
        if (with_reference) {
            const auto scattered = scattered_sun(input, band.node_um);
            for (std::size_t k = 0; k < seen.hops.pixel.size(); k += 41) {
                seen.reference.push_back(hop_radiance(seen.hops, k, plumes,
                                                      seen.view.observer_height, band, input,
                                                      scattered ? &*scattered : nullptr));
            }
        }
        return seen;
    }
};

Material plain(double reflectance) { return testing::material("wall", flat_spectrum(reflectance)); }

Material pane(double reflectance, double transmittance, Finish finish = Lambert{}) {
    Material material =
        testing::material("pane", flat_spectrum(reflectance), flat_spectrum(transmittance));
    material.see_through = true;
    material.finish = std::move(finish);
    return material;
}

Material metal(double reflectance, double roughness) {
    Material material = testing::material("metal", flat_spectrum(reflectance));
    material.finish = Glossy{.roughness = roughness, .metal = true, .index = {}, .extinction = {}};
    return material;
}

const Band lwir = flat_band("8-12", 8.0, 12.0, bin_edges_um());
const Band mwir = flat_band("3-5", 3.0, 5.0, bin_edges_um());

}  // namespace

TEST_CASE("a pane shows what is behind and glows itself", "[render][hops]") {
    Stage stage;
    stage.wall(60.0, 20.0, plain(0.0), 320.0f);
    stage.wall(30.0, 5.0, pane(0.0, 0.6), 290.0f);
    const auto seen = stage.look(stage.observer(), mwir);
    REQUIRE(seen.hops.pixel.size() == 25);
    const double expected = 0.6 * band_radiance(mwir, 320.0) + 0.4 * band_radiance(mwir, 290.0);
    CHECK(seen.at(12) == Approx(expected).epsilon(1e-6));
    CHECK(seen.planes[std::size_t(Term::behind)][12] ==
          Approx(0.6 * band_radiance(mwir, 320.0)).epsilon(1e-6));
    CHECK(seen.planes[std::size_t(Term::emitted)][12] ==
          Approx(0.4 * band_radiance(mwir, 290.0)).epsilon(1e-6));
}

// Two nets that cover 0.7 and 0.4, one behind the other: 0.7 + 0.3 (0.4 + 0.6 wall).
TEST_CASE("nets in a row cover by their shares", "[render][hops]") {
    Stage stage;
    stage.wall(80.0, 20.0, plain(0.0), 350.0f);
    stage.wall(30.0, 5.0, pane(0.0, 0.3), 285.0f);
    stage.wall(40.0, 6.0, pane(0.0, 0.6), 300.0f);
    const auto seen = stage.look(stage.observer(), lwir);
    const double expected =
        0.7 * band_radiance(lwir, 285.0) +
        0.3 * (0.4 * band_radiance(lwir, 300.0) + 0.6 * band_radiance(lwir, 350.0));
    CHECK(seen.at(12) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("a plume absorbs and emits by Beer and Lambert", "[render][hops][plume]") {
    const double absorption = GENERATE(0.02, 0.3, 2.0), thickness = 4.0;
    Stage stage;
    stage.wall(60.0, 20.0, plain(0.0), 300.0f);
    stage.plume(20.0, thickness, absorption, 700.0);
    const auto seen = stage.look(stage.observer(5, 0.5), mwir);
    const double through = std::exp(-absorption * thickness);
    const double expected =
        through * band_radiance(mwir, 300.0) + (1.0 - through) * band_radiance(mwir, 700.0);
    CAPTURE(absorption);
    CHECK(seen.at(12) == Approx(expected).epsilon(2e-5));  // the ray's slant: 0.15 deg at most
    // In front of the cold sky it shines alone.
    Stage open;
    open.wall(-60.0, 1.0, plain(0.0), 300.0f);
    open.plume(20.0, thickness, absorption, 700.0);
    CHECK(open.look(open.observer(5, 0.5), mwir).at(12) ==
          Approx((1.0 - through) * band_radiance(mwir, 700.0)).epsilon(2e-5));
}

TEST_CASE("plumes in a row, and an eye inside one", "[render][hops][plume]") {
    Stage stage;
    stage.wall(60.0, 20.0, plain(0.0), 300.0f);
    stage.plume(20.0, 2.0, 0.2, 500.0);
    stage.plume(30.0, 3.0, 0.1, 400.0);
    stage.plume(-1.0, 6.0, 0.05, 350.0);  // 5 m of it before the eye
    const double a = std::exp(-0.25), b = std::exp(-0.4), c = std::exp(-0.3);
    const double expected =
        (1 - a) * band_radiance(lwir, 350.0) +
        a * ((1 - b) * band_radiance(lwir, 500.0) +
             b * ((1 - c) * band_radiance(lwir, 400.0) + c * band_radiance(lwir, 300.0)));
    CHECK(stage.look(stage.observer(5, 0.5), lwir).at(12) == Approx(expected).epsilon(2e-5));
}

TEST_CASE("a plume's mesh must be closed", "[render][hops][plume]") {
    Stage stage;
    stage.plume(20.0, 2.0, 0.2, 500.0);
    stage.plumes[0].triangle.pop_back();
    CHECK_THROWS_AS(PlumeScene(stage.plumes), InputError);
    Plume column{.name = "smoke",
                 .vertex = frustum_vertices({0, 0, 0}, 1.0, 3.0, 10.0, {4.0, 0.0}, 24),
                 .triangle = frustum_triangles(24),
                 .absorption = flat_spectrum(0.1),
                 .temperature = 300.0};
    const PlumeScene scene({&column, 1});
    // Through the axis at half height: the middle circle's diameter of 4 m, less what 24 sides cut.
    const auto chords = scene.chords({2.0, -20.0, 5.0}, {0.0, 1.0, 0.0}, 1e3);
    REQUIRE(chords.size() == 1);
    CHECK(chords[0].to - chords[0].from == Approx(4.0).epsilon(0.01));
    CHECK(scene.chords({2.0, -20.0, 5.0}, {0.0, 1.0, 0.0}, 20.0)[0].to == Approx(20.0));
}

// A polished metal wall, tilted by 45° so that it shows what lies below the line of sight: ground
// at 330 K. L = ρ(45°) B(330) + (1 − ρ(45°)) B(280), Schlick's ρ(45°) = ρ + (1 − ρ)(1 − cos 45°)^5.
TEST_CASE("a mirror shows what the reflected ray meets", "[render][hops]") {
    Stage stage;
    stage.rectangle({{-4, 34, -4}, {4, 34, -4}, {4, 26, 4}, {-4, 26, 4}}, metal(0.8, 0.0), 280.0f);
    stage.rectangle({{-60, -40, -20}, {60, -40, -20}, {60, 100, -20}, {-60, 100, -20}}, plain(0.0),
                    330.0f);
    const auto seen = stage.look(stage.observer(), lwir);
    const double mirrored = 0.8 + 0.2 * std::pow(1.0 - std::cos(radians(45.0)), 5);
    CHECK(seen.at(12) == Approx(mirrored * band_radiance(lwir, 330.0) +
                                (1.0 - mirrored) * band_radiance(lwir, 280.0))
                             .epsilon(1e-5));
    CHECK(seen.planes[std::size_t(Term::surroundings)][12] ==
          Approx(mirrored * band_radiance(lwir, 330.0)).epsilon(1e-5));
}

// The share of a rough mirror's lobe that falls on the half-space below a level plane, sampled by
// the renderer and integrated over the lobe itself.
TEST_CASE("a rough mirror's lobe is sampled as it is", "[render][hops]") {
    const double roughness = GENERATE(0.1, 0.3);
    Stage stage;
    stage.rectangle({{-4, 34, -4}, {4, 34, -4}, {4, 26, 4}, {-4, 26, 4}}, metal(1.0, roughness),
                    280.0f);
    // Large and far below: nearly the half-space north of the mirror's foot and below it.
    stage.rectangle({{-8000, 0, -10}, {8000, 0, -10}, {8000, 30, -10}, {-8000, 30, -10}},
                    plain(0.0), 330.0f);
    constexpr int size = 9, samples = 256;
    const auto seen = stage.look(stage.observer(size, 0.2), lwir, samples);
    double mean = 0.0;
    for (std::size_t p = 0; p < seen.view.pixels(); ++p) mean += seen.at(p);
    const double share = mean / double(seen.view.pixels()) / band_radiance(lwir, 330.0);

    const Microfacets surface{.roughness = roughness};
    const Eigen::Vector3d normal = Eigen::Vector3d(0, -1, -1).normalized(),
                          y = Eigen::Vector3d::UnitX(), x = y.cross(normal);
    const Eigen::Vector3d eye(-x.y(), -y.y(), -normal.y());  // −north in the mirror's frame
    double hit = 0.0, all = 0.0;
    constexpr int n = 700;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < 2 * n; ++k) {
            const double theta = (i + 0.5) / n * 0.5 * std::numbers::pi;
            const double phi = (k + 0.5) / n * std::numbers::pi;
            const Eigen::Vector3d d(std::sin(theta) * std::cos(phi),
                                    std::sin(theta) * std::sin(phi), std::cos(theta));
            const double weight = surface.lobe(eye, d) * d.z() * std::sin(theta);
            const Eigen::Vector3d out = d.x() * x + d.y() * y + d.z() * normal;
            all += weight;
            if (out.z() >= 0.0) continue;
            const double north = 30.0 - 10.0 * out.y() / out.z();
            const double east = -10.0 * out.x() / out.z();
            if (north > 0.0 && north < 30.0 && std::abs(east) < 8000.0) hit += weight;
        }
    }
    const double expected = hit / all;
    const double deviation =
        std::sqrt(expected * (1.0 - expected) / (double(size) * size * samples));
    CAPTURE(roughness, share, expected, deviation);
    // 4σ; one in four of the visible microfacets picked by weight is off by up to 0.3 % of the
    // lobe.
    CHECK(std::abs(share - expected) < 4.0 * deviation + 3e-3);
}

// Kirchhoff with all of it at once: pane, net, plume, mirrors smooth and rough, directional paint,
// hills and hazy air, one temperature.
TEST_CASE("an isothermal enclosure with plume, net and mirrors looks black",
          "[render][hops][furnace]") {
    const double kelvins = GENERATE(220.0, 300.0, 345.0);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    Stage stage;
    stage.air = BandModel{.profile = isothermal(afgl_profile("MLS"), kelvins),
                          .aerosol = "rural",
                          .visibility_km = 5.0,
                          .space_temperature = kelvins};
    const auto warm = static_cast<float>(kelvins);
    stage.rectangle({{-90, -40, -9}, {90, -40, -9}, {90, 400, -9}, {-90, 400, -9}}, plain(0.3),
                    warm);
    stage.wall(200.0, 8.0, metal(0.9, 0.2), warm);
    stage.rectangle({{-9, 150, -9}, {-1, 150, -9}, {-1, 155, 5}, {-9, 155, 5}}, metal(0.7, 0.0),
                    warm);
    stage.wall(
        60.0, 4.0,
        pane(0.2, 0.5,
             Glossy{
                 .roughness = 0.0, .metal = false, .index = flat_spectrum(1.5), .extinction = {}}),
        warm);
    stage.wall(50.0, 2.0, pane(0.1, 0.4), warm);
    Material paint = testing::material("paint", {{0.2, 4.0, 20.0}, {0.6, 0.3, 0.08}});
    paint.finish = Glossy{.roughness = 0.3,
                          .metal = false,
                          .index = flat_spectrum(1.5),
                          .extinction = flat_spectrum(0.1)};
    stage.rectangle({{2, 100, -9}, {9, 103, -9}, {9, 103, 5}, {2, 100, 5}}, paint, warm);
    stage.plume(30.0, 5.0, 0.1, kelvins);
    const auto seen = stage.look(stage.observer(33, 16.0), band, 16);
    REQUIRE(seen.hops.pixel.size() > 300);
    std::size_t mirrored = 0, through = 0, plumes = 0, skies = 0;
    for (const Hop& hop : seen.hops.hop) {
        mirrored += hop.way == Hop::Way::mirrored;
        through += hop.way == Hop::Way::through;
        plumes += hop.kind == Hop::Kind::plume;
        skies += hop.kind == Hop::Kind::sky;
    }
    CHECK(std::min({mirrored, through, plumes, skies}) > 100);
    const double black = band_radiance(band, kelvins);
    double worst = 0.0;
    for (const std::uint32_t p : seen.hops.pixel) {
        worst = std::max(worst, std::abs(seen.at(p) / black - 1.0));
    }
    CAPTURE(kelvins, band.name, worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("hops agree with the sum over wavelengths", "[render][hops]") {
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    Stage stage;
    stage.air =
        BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
    stage.rectangle(
        {{-400, -40, -9}, {400, -40, -9}, {400, 900, -9}, {-400, 900, -9}},
        testing::material("soil", {{0.2, 3.0, 4.0, 5.0, 8.0, 9.2, 10.0, 12.0, 20.0},
                                   {0.3, 0.25, 0.2, 0.15, 0.08, 0.15, 0.05, 0.03, 0.03}}),
        300.0f);
    Material glass =
        testing::material("glass", {{0.2, 8.0, 9.5, 11.0, 20.0}, {0.08, 0.05, 0.25, 0.1, 0.1}},
                          {{0.2, 2.7, 3.5, 4.6, 5.0, 20.0}, {0.8, 0.75, 0.4, 0.1, 0.0, 0.0}});
    glass.see_through = true;
    glass.finish =
        Glossy{.roughness = 0.0, .metal = false, .index = flat_spectrum(1.5), .extinction = {}};
    stage.wall(60.0, 6.0, glass, 285.0f);
    stage.rectangle({{-9, 150, -9}, {-1, 150, -9}, {-1, 155, 9}, {-9, 155, 9}}, metal(0.7, 0.1),
                    310.0f);
    stage.plume(30.0, 3.0, 0.05, 400.0);
    stage.sun.assign(stage.facets.size(), 1.0f);
    const auto seen = stage.look(stage.observer(17, 16.0), band, 16, true);
    double worst = 0.0;
    for (std::size_t k = 0; k < seen.hops.pixel.size(); k += 41) {
        worst = std::max(worst, std::abs(brightness_temperature(band, seen.at(seen.hops.pixel[k])) -
                                         brightness_temperature(band, seen.reference[k / 41])));
    }
    CAPTURE(band.name, worst);
    CHECK(seen.hops.pixel.size() > 50);
    CHECK(worst < 5e-3);
}

// Each sample's hops by themselves against the same samples merged: a pane, a rough mirror and
// smoke before a wall and sky, seen at a slant.
TEST_CASE("samples that met the same are kept once, to 2 mK", "[render][hops][merge]") {
    Stage stage;
    stage.air =
        BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
    stage.rectangle({{-400, -40, -9}, {400, -40, -9}, {400, 900, -9}, {-400, 900, -9}}, plain(0.1),
                    300.0f);
    stage.wall(
        60.0, 6.0,
        pane(0.2, 0.5,
             Glossy{
                 .roughness = 0.0, .metal = false, .index = flat_spectrum(1.5), .extinction = {}}),
        285.0f);
    stage.rectangle({{-9, 100, -9}, {-1, 140, -9}, {-1, 145, 9}, {-9, 105, 9}}, metal(0.7, 0.1),
                    310.0f);
    stage.plume(30.0, 3.0, 0.1, 340.0);
    const RayScene scene(stage.facets);
    const MaterialLibrary materials(stage.all);
    const SkyView sky = sky_view(stage.facets, scene, {.rays = 64});
    const PlumeScene volumes(stage.plumes);
    const Observer observer = stage.observer(24, 16.0);
    const HopScene place{.scene = scene,
                         .facets = stage.facets,
                         .materials = materials,
                         .plumes = volumes,
                         .observer = observer};
    const PixelRays eye = pixel_rays(observer);
    Hops merged, apart;
    merged.row = apart.row = {0};
    for (std::uint32_t p = 0; p < 24 * 24; ++p) {
        std::vector<Hop> one;
        for (int s = 0; s < 16; ++s) {
            Chance chance{std::uint64_t{p} * 16 + std::uint64_t(s) + 1};
            std::vector<Hop> sample;
            walk(place, Eigen::Vector3d::Zero(), eye.towards(p % 24 + chance(), p / 24 + chance()),
                 1.0f / 16.0f, chance, sample);
            add_sample(sample, volumes, one);
            const auto offset = std::int32_t(apart.hop.size() - apart.row.back());
            for (Hop hop : sample) {
                if (hop.before >= 0) hop.before += offset;
                apart.hop.push_back(hop);
            }
        }
        merged.hop.insert(merged.hop.end(), one.begin(), one.end());
        for (Hops* hops : {&merged, &apart}) {
            hops->pixel.push_back(p);
            hops->row.push_back(static_cast<std::uint32_t>(hops->hop.size()));
        }
    }
    const RadianceInput input{.facets = stage.facets,
                              .sky_view = sky,
                              .materials = materials,
                              .atmosphere = stage.air,
                              .temperature = stage.temperature,
                              .ground_height_km = 0.3};
    double worst = 0.0;
    std::array<std::vector<std::vector<float>>, 2> planes;
    for (const std::size_t i : {0u, 1u}) {
        planes[i].assign(1, std::vector<float>(24 * 24, 0.0f));
        HopLight(i == 0 ? merged : apart, stage.plumes, 0.0, {&lwir, 1}, input).add(planes[i]);
    }
    for (std::size_t p = 0; p < 24 * 24; ++p) {
        worst = std::max(worst, std::abs(brightness_temperature(lwir, double{planes[0][0][p]}) -
                                         brightness_temperature(lwir, double{planes[1][0][p]})));
    }
    CAPTURE(merged.hop.size(), apart.hop.size(), worst);
    CHECK(worst < 2e-3);
    CHECK(3 * merged.hop.size() < apart.hop.size());
}

TEST_CASE("hops are the same for any number of threads", "[render][hops]") {
    Stage stage;
    stage.wall(60.0, 20.0, metal(0.5, 0.3), 320.0f);
    stage.wall(30.0, 5.0, pane(0.1, 0.6), 290.0f);
    std::vector<float> first;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        const auto seen = stage.look(stage.observer(), lwir);
        if (first.empty()) first = seen.planes[0];
        CHECK(seen.planes[0] == first);
    }
    set_thread_count(0);
}
