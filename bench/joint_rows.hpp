#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/thermal_rows.hpp"
#include "tests/support/black_plates.hpp"
#include "tests/support/box_shadow.hpp"
#include "tests/support/canyon.hpp"
#include "tests/support/hall.hpp"
#include "tests/support/hanging_sheets.hpp"
#include "tests/support/hourly_sun.hpp"
#include "tests/support/level_squares.hpp"
#include "tests/support/redone.hpp"
#include "tests/support/triangle_sheet.hpp"
#include "thermal/solve/facet_exchange.hpp"

/// Rows of the validation table where parts meet: weather and walls, surface and surface, buildings
/// and ground.
namespace joint_rows {

using namespace diurna;
using namespace diurna::testing;

/// Direct light on walls from hourly global sunlight alone, worst of three walls.
inline std::string hourly_sun() {
    const Minutes truth = clear_day(36.0, "2026-03-21T00:00:00Z");
    const Minutes got = put_back(truth, means(truth, 60, {true, false, false}));
    double rms = 0.0, largest = 0.0;
    for (const double azimuth : {90.0, 180.0, 270.0}) {
        const Figures f = compare(truth, got, azimuth);
        rms = std::max(rms, f.rms);
        largest = std::max(largest, f.largest);
    }
    return fmt::format("{:.0f} W/m² rms, peaks {:.2f} of the true", rms, largest);
}

/// White sky in a long canyon of albedo 0.85, half again as deep as wide: light on floor and walls.
inline std::string canyon_light() {
    constexpr double albedo = 0.85, width = 10.0, height = 15.0, diffuse = 300.0;
    const LongCanyon canyon(height, width, 1024, {MaterialId{0}, MaterialId{1}});
    FacetOptics optics;
    optics.albedo.assign(canyon.side.size(), float(albedo));
    optics.emissivity.assign(canyon.side.size(), 0.0f);
    std::vector<SkyState> sky(1);
    sky[0].to_sun = Eigen::Vector3d::UnitZ();
    sky[0].diffuse_horizontal = diffuse;
    std::vector<float> incident(canyon.facets.size());
    incident_sunlight({.facets = canyon.facets, .views = canyon.views, .optics = optics},
                      {.sky = {.sky = sky}, .fraction = {}}, incident);
    const CanyonLight exact = endless_canyon(
        height, width, [](int, double open) { return diffuse * open; }, [](int) { return albedo; },
        [](int) { return 0.0; });
    const auto found = [&](std::size_t f) { return incident[f]; };
    return fmt::format("{:+.1f}, {:+.1f} %",
                       100.0 * (canyon.mean(0, -1.0, 1.0, found) / exact.mean(0, -1, 1) - 1.0),
                       100.0 * (canyon.mean(1, 0.0, height, found) / exact.mean(1, 0, height) - 1));
}

/// The beam's share on ground under a net that covers 0.65.
inline std::string under_a_net() {
    Layers world;
    world.sheet(0.0, 5.0, 8, material("ground", flat_spectrum(0.2)));
    world.sheet(3.0, 60.0, 30, net("net", 0.65));
    const std::vector<float> fraction = world.sunlit(direction(140.0, 35.0), 4);
    return fmt::format(
        "{:+.4f}", world.mean(0, 6.0, [&](std::size_t f) { return double(fraction[f]); }) - 0.35);
}

/// Sunlit walls of a hall on a slope, from eaves to foot.
inline std::string wall_foot() {
    using namespace sunlit_hall;
    const Hall scene = hall(0.07);
    const World& world = scene.prepared.world;
    const Instant noon = parse_instant("2026-03-21T11:00:00Z");
    const Eigen::Vector3d to_sun = sun_direction(sun_position(world.site, noon));
    const std::vector<float> kelvin = scene.temperature.interpolate(noon);
    double worst = 0.0;
    for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
        const double cosine = world.facets.normal[f].cast<double>().dot(to_sun);
        if (world.facets.normal[f].z() > 0.5f || cosine < 0.1) continue;
        const double exact = air + beam * cosine / (film + through_wall);
        worst = std::max(worst, std::abs(double(kelvin[f]) - exact));
    }
    return fmt::format("{:.2f} K worst", worst);
}

/// Ground within 2 m of the middle of a sheet with 500 W/m², two metres up.
inline std::string heated_sheet() {
    using namespace over_plain;
    const double exact = under_heated_sheet().mean(0.0, 2.0);
    return fmt::format("{:+.2f} K of {:.2f}",
                       over_plain::heated_sheet("").kelvin("12:00", true, 0.0, 2.0) - exact,
                       exact - air);
}

/// Outline of a box's shadow, the worst of suns at 12, 25, 45, 65°.
inline std::string shadow_outline() {
    double worst = 1.0;
    for (const double elevation : {12.0, 25.0, 45.0, 65.0}) {
        BoxStage stage(1.5, elevation);
        const BoxStage::Picture picture = stage.picture();
        worst = std::min(worst, overlap(stage, picture.view, picture.by_pixel));
    }
    return fmt::format("{:.3f} worst", worst);
}

/// 200 pixels of a textured airfield with a hangar, in the morning, from planes and library.
inline std::string redone_pixels() {
    const redone::Job job(redone::airfield());
    std::string worst;
    for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
        worst += fmt::format("{}{:.3f}", worst.empty() ? "" : ", ",
                             100.0 * redone::redo(job, "east", band, "120000").worst);
    }
    return worst + " % worst";
}

/// 200 pixels each that see a pond or a glass front, from 15 m.
inline std::string redone_mirrors() {
    const redone::Job job(redone::waterside("15.0"));
    std::string worst;
    for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
        worst += fmt::format("{}{:.3f}", worst.empty() ? "" : ", ",
                             100.0 * redone::redo_mirrors(job, "east", band, "120000").worst);
    }
    return worst + " % worst";
}

/// Black plates at 0, 45, 90, 135 degrees, in the open and in a street.
inline std::string plates_under_sky() {
    double worst = 0.0;
    for (const bool street : {false, true}) {
        for (const PlateKelvin& plate : black_plates(street)) {
            worst = std::max(worst, std::abs(plate.solved - plate.exact));
        }
    }
    return fmt::format("{:.3f} K worst", worst);
}

inline std::string conducting_sheets() {
    return fmt::format("{:.3f}, {:.3f} K worst", heated_fin().worst, fading_plate().worst);
}

inline std::vector<thermal_rows::Case> cases() {
    return {
        {"direct light on walls from hourly global sunlight, a clear day at 36°",
         "the day by the minute (Meinel)", "74 to 113 W/m², peaks to 2.9 a line over sin h",
         hourly_sun},
        {"white sky on floor and walls of a canyon, albedo 0.85, height 1.5 widths",
         "crossed strings (Hottel)", "-24 % two bounces", canyon_light},
        {"the beam's share under a net of cover 0.65", "0.35", "-0.35 if nets were opaque roofs",
         under_a_net},
        {"sunlit walls on a slope, eaves to foot", "closed form",
         "33 K facets that dip into the ground", wall_foot},
        {"ground warmed by a sheet over it, 500 W/m²", "sums over squares",
         "-5.4 K one-sided sheets", heated_sheet},
        {"a box's shadow on facets of 1.5 m, intersection over union, suns of 12 to 65°",
         "the sun's ray through each pixel", "0.73 by facets", shadow_outline},
        {"radiance of 200 pixels in 3–5, 8–12, 0.62–0.66 µm", "added up from planes and library",
         "", redone_pixels},
        {"the same, 200 that see a pond or a glass front", "with Fresnel of n and k", "",
         redone_mirrors},
        {"black plates at 0, 45, 90, 135° in the open and in a street",
         "sky summed over directions", "4 K view times horizontal mean", plates_under_sky},
        {"a target's sheets: fin of 65 K, pattern fading on uneven triangles",
         "Incropera 3.6; Carslaw & Jaeger 3.3",
         "12 % too much on right triangles, links of centroids (worked out)", conducting_sheets}};
}

}  // namespace joint_rows
