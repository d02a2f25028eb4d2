#include "render/rays/secondary_rays.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/measured_brdf.hpp"
#include "materials/matter/microfacet.hpp"
#include "materials/radiation/planck.hpp"
#include "render/path/background.hpp"
#include "render/rays/merge.hpp"
#include "render/rays/secondary_light.hpp"
#include "render/rays/walk.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/isothermal.hpp"
#include "tests/support/secondary_stage.hpp"

using namespace diurna;

TEST_CASE("a pane shows what is behind and glows itself", "[render][secondary]") {
    SecondaryStage stage;
    stage.wall(60.0, 20.0, plain(0.0), 320.0f);
    stage.wall(30.0, 5.0, pane(0.0, 0.6), 290.0f);
    const auto seen = stage.look(stage.observer(), mwir);
    REQUIRE(seen.secondary_rays.pixel.size() == 25);
    const double expected = 0.6 * band_radiance(mwir, 320.0) + 0.4 * band_radiance(mwir, 290.0);
    CHECK(seen.at(12) == Approx(expected).epsilon(1e-6));
    CHECK(seen.planes[std::size_t(Term::behind)][12] ==
          Approx(0.6 * band_radiance(mwir, 320.0)).epsilon(1e-6));
    CHECK(seen.planes[std::size_t(Term::emitted)][12] ==
          Approx(0.4 * band_radiance(mwir, 290.0)).epsilon(1e-6));
}

// Two nets that cover 0.7 and 0.4, one behind the other: 0.7 + 0.3 (0.4 + 0.6 wall).
TEST_CASE("nets in a row cover by their shares", "[render][secondary]") {
    SecondaryStage stage;
    stage.wall(80.0, 20.0, plain(0.0), 350.0f);
    stage.wall(30.0, 5.0, pane(0.0, 0.3), 285.0f);
    stage.wall(40.0, 6.0, pane(0.0, 0.6), 300.0f);
    const auto seen = stage.look(stage.observer(), lwir);
    const double expected =
        0.7 * band_radiance(lwir, 285.0) +
        0.3 * (0.4 * band_radiance(lwir, 300.0) + 0.6 * band_radiance(lwir, 350.0));
    CHECK(seen.at(12) == Approx(expected).epsilon(1e-6));
}

// A polished metal wall, tilted by 45° so that it shows what lies below the line of sight: ground
// at 330 K. L = ρ(45°) B(330) + (1 − ρ(45°)) B(280), Schlick's ρ(45°) = ρ + (1 − ρ)(1 − cos 45°)^5.
TEST_CASE("a mirror shows what the reflected ray meets", "[render][secondary]") {
    SecondaryStage stage;
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
TEST_CASE("a rough mirror's lobe is sampled as it is", "[render][secondary]") {
    const double roughness = GENERATE(0.1, 0.3);
    SecondaryStage stage;
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
            const double weight =
                surface.lobe((eye + d).normalized().z(), eye.z(), d.z()) * d.z() * std::sin(theta);
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
          "[render][secondary][furnace][by_degenerate]") {
    const double kelvins = GENERATE(220.0, 300.0, 345.0);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    SecondaryStage stage;
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
    REQUIRE(seen.secondary_rays.pixel.size() > 300);
    std::size_t mirrored = 0, through = 0, plumes = 0, skies = 0;
    for (const SecondaryRay& secondary : seen.secondary_rays.secondary) {
        mirrored += secondary.way == SecondaryRay::Way::mirrored;
        through += secondary.way == SecondaryRay::Way::through;
        plumes += secondary.kind == SecondaryRay::Kind::plume;
        skies += secondary.kind == SecondaryRay::Kind::sky;
    }
    CHECK(std::min({mirrored, through, plumes, skies}) > 100);
    const double black = band_radiance(band, kelvins);
    double worst = 0.0;
    for (const std::uint32_t p : seen.secondary_rays.pixel) {
        worst = std::max(worst, std::abs(seen.at(p) / black - 1.0));
    }
    CAPTURE(kelvins, band.name, worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("secondary rays agree with the sum over wavelengths", "[render][secondary]") {
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    SecondaryStage stage;
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
    for (std::size_t k = 0; k < seen.secondary_rays.pixel.size(); k += 41) {
        worst = std::max(
            worst, std::abs(brightness_temperature(band, seen.at(seen.secondary_rays.pixel[k])) -
                            brightness_temperature(band, seen.reference[k / 41])));
    }
    CAPTURE(band.name, worst);
    CHECK(seen.secondary_rays.pixel.size() > 50);
    CHECK(worst < 5e-3);
}

// f = (1 + cos φ sinθ sinθ') / 10, as a table every 5° and 15°: its mean over the lights is π / 10
// at every angle, so that a diffuse wall of the same reflectance differs from it by f / 0.1 in the
// sun.
TEST_CASE("a measured BRDF reflects the sun to the camera by its own value",
          "[render][secondary]") {
    MeasuredBrdf table;
    for (double a = 0.0; a <= 90.0; a += 5.0) table.first.push_back(a);
    table.second = table.first;
    for (double a = 0.0; a <= 180.0; a += 15.0) table.third.push_back(a);
    for (const double light : table.first) {
        for (const double eye : table.second) {
            for (const double azimuth : table.third) {
                table.value.push_back(static_cast<float>(
                    0.1 * (1.0 + std::cos(radians(azimuth)) * std::sin(radians(light)) *
                                     std::sin(radians(eye)))));
            }
        }
    }
    const Eigen::Vector3d low_sun = direction(200.0, 12.0);
    const auto sunlit = [&](Finish finish) {
        SecondaryStage stage;
        stage.to_sun = low_sun;
        Material wall = testing::material("wall", flat_spectrum(0.4));
        wall.finish = std::move(finish);
        stage.rectangle({{-4, 26, -4}, {4, 26, -4}, {4, 34, 4}, {-4, 34, 4}}, wall, 280.0f);
        stage.sun.assign(stage.facets.size(), 1.0f);
        const auto seen = stage.look(stage.observer(), flat_band("", 0.62, 0.66), 16, true);
        CHECK(seen.at(seen.secondary_rays.pixel[0]) == Approx(seen.reference[0]).epsilon(1e-3));
        return double{seen.planes[std::size_t(Term::sun)][12]};
    };
    const double diffuse = sunlit(ByAngle{{0.0, 90.0}, {1.0, 1.0}});
    const Eigen::Vector3d normal = Eigen::Vector3d(0, -1, 1).normalized(), eye(0, -1, 0);
    REQUIRE(diffuse > 0.0);
    const double expected = 1.0 + eye.dot(low_sun) - normal.dot(eye) * normal.dot(low_sun);
    CHECK(expected > 1.3);
    CHECK(sunlit(finish_of(table)) / diffuse == Approx(expected).epsilon(0.01));
}

// An upright perfect mirror leaves the air, the same everywhere at a height, as it is: what it
// shows to the north is what is seen without it, the light's way being as long and as thick. The
// sun stands in the east, in the mirror's plane.
TEST_CASE("a perfect mirror across the line of sight changes nothing",
          "[render][secondary][joined]") {
    const Band band = GENERATE(
        flat_band("0.7-1.0", 0.7, 1.0, bin_edges_um()), flat_band("3-5", 3.0, 5.0, bin_edges_um()),
        flat_band("4.5-5", 4.5, 5.0, bin_edges_um()), flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const bool day = GENERATE(false, true);
    if (!day && band.to_um() < 2.0) return;
    const double away = GENERATE(100.0, 1000.0, 4000.0);
    SecondaryStage with, without;
    for (SecondaryStage* stage : {&with, &without}) {
        stage->air =
            BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
        stage->to_sun = direction(90.0, 40.0);
        stage->rectangle({{-9, 5, -9}, {9, 5, -9}, {9, 9, -9}, {-9, 9, -9}}, plain(0.1), 290.0f);
    }
    with.wall(away, away, metal(1.0, 0.0), 290.0f);
    for (SecondaryStage* stage : {&with, &without}) {
        stage->sun.assign(stage->facets.size(), day ? 1.0f : 0.0f);
        if (!day) stage->sun.clear();
    }
    Observer observer = with.observer(3, 1.0);
    observer.elevation_deg = 25.0;
    const auto seen = with.look(observer, band);
    const RadianceInput input{.facets = without.facets,
                              .views = {},
                              .materials = MaterialLibrary(without.all),
                              .atmosphere = without.air,
                              .temperature = without.temperature,
                              .sun_fraction = without.sun,
                              .to_sun = without.to_sun,
                              .sun_zenith_deg = 50.0,
                              .ground_height_km = without.ground_km};
    double direct = band_sum_nodes(band, background_at(input, 0.3, 65.0, band.node_um));
    if (const auto scattered = scattered_sun(input, band.node_um)) {
        const double azimuth_deg = 90.0;
        direct += band_sum_nodes(
            band,
            scattered_backgrounds_at(input, *scattered, 0.3, 65.0, {&azimuth_deg, 1}).front());
    }
    CAPTURE(band.name, day, away, direct);
    REQUIRE(seen.secondary_rays.pixel.size() == 9);
    CHECK(seen.at(4) == Approx(direct).epsilon(3e-3));
}

// Each sample's secondary rays by themselves against the same samples merged: a pane, a rough
// mirror and smoke before a wall and sky, seen at a slant.
TEST_CASE("samples that met the same are stored once, to 2 mK", "[render][secondary][merge]") {
    SecondaryStage stage;
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
    const FacetViews sky = facet_views(stage.facets, scene, {.rays = 64});
    const PlumeScene volumes(stage.plumes);
    const Observer observer = stage.observer(24, 16.0);
    const SecondaryScene place{
        .rays = scene, .facets = stage.facets, .materials = materials, .plumes = volumes};
    const PixelRays eye = pixel_rays(observer);
    SecondaryRays merged, apart;
    merged.row = apart.row = {0};
    for (std::uint32_t p = 0; p < 24 * 24; ++p) {
        std::vector<SecondaryRay> one;
        for (int s = 0; s < 16; ++s) {
            RandomStream chance{std::uint64_t{p} * 16 + std::uint64_t(s) + 1};
            std::vector<SecondaryRay> sample;
            const Eigen::Vector3d towards = eye.towards(p % 24 + chance(), p / 24 + chance());
            walk(place,
                 {.origin = Eigen::Vector3d::Zero(), .direction = towards, .weight = 1.0f / 16.0f},
                 chance, sample);
            add_sample(sample, volumes, one);
            const auto offset = std::int32_t(apart.secondary.size() - apart.row.back());
            for (SecondaryRay secondary : sample) {
                if (secondary.before >= 0) secondary.before += offset;
                apart.secondary.push_back(secondary);
            }
        }
        merged.secondary.insert(merged.secondary.end(), one.begin(), one.end());
        for (SecondaryRays* secondary_rays : {&merged, &apart}) {
            secondary_rays->pixel.push_back(p);
            secondary_rays->row.push_back(
                static_cast<std::uint32_t>(secondary_rays->secondary.size()));
        }
    }
    const RadianceInput input{.facets = stage.facets,
                              .views = sky,
                              .materials = materials,
                              .atmosphere = stage.air,
                              .temperature = stage.temperature,
                              .ground_height_km = 0.3};
    double worst = 0.0;
    std::array<std::vector<std::vector<float>>, 2> planes;
    for (const std::size_t i : {0u, 1u}) {
        planes[i].assign(1, std::vector<float>(24 * 24, 0.0f));
        SecondaryLight(i == 0 ? merged : apart, stage.plumes, {&lwir, 1}, input).add(planes[i]);
    }
    for (std::size_t p = 0; p < 24 * 24; ++p) {
        worst = std::max(worst, std::abs(brightness_temperature(lwir, double{planes[0][0][p]}) -
                                         brightness_temperature(lwir, double{planes[1][0][p]})));
    }
    CAPTURE(merged.secondary.size(), apart.secondary.size(), worst);
    CHECK(worst < 2e-3);
    CHECK(3 * merged.secondary.size() < apart.secondary.size());
}

TEST_CASE("secondary rays are the same for any number of threads",
          "[render][secondary][by_replication]") {
    SecondaryStage stage;
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
