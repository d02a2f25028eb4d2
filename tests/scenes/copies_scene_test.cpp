#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/world/surroundings.hpp"
#include "tests/support/copied_crates.hpp"

// Copies that share facets and temperatures, against the same objects built out one by one.

using namespace diurna;
using namespace copied_crates;
namespace fs = std::filesystem;

namespace {

struct Solved {
    Prepared prepared;
    SpanResult result;

    std::size_t object(const std::string& name) const {
        const auto& names = prepared.world.objects;
        return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
    }
};

Solved solved(const fs::path& folder, const std::string& objects) {
    Prepared prepared = prepare(read_scene(written(folder, objects)));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(result)};
}

/// A copy's facets and where they are.
struct Placed {
    std::uint32_t first, facets;
    Eigen::Isometry3d pose;
};
Placed place_of(const World& world, ObjectId id) {
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        if (copy.object == id) return {copy.first, copy.facets, copy.pose};
    }
    Placed own{0, 0, Eigen::Isometry3d::Identity()};
    for (std::uint32_t f = 0; f < world.facets.size(); ++f) {
        if (world.facets.object[f] != id) continue;
        if (own.facets++ == 0) own.first = f;
    }
    return own;
}

}  // namespace

TEST_CASE("copies that share temperatures have those they would have apart", "[scenes][copies]") {
    const ScratchFolder folder("copies_heat");
    const Solved shared = solved(folder.path / "shared", copies(alike_within));
    const Solved each = solved(folder.path / "apart", copies(0.0));
    const World& world = shared.prepared.world;
    CHECK(world.objects == each.prepared.world.objects);
    // The one by itself is like no other; of the ten in rows some are.
    const std::size_t own = stands.size() - world.copies.size();
    CAPTURE(own);
    CHECK(own >= 2);
    CHECK(own < stands.size());
    CHECK(world.facets.size() < each.prepared.world.facets.size());
    const std::string note =
        fmt::format("{} copies of 'crate' share the temperatures of {}", stands.size(), own);
    CHECK(std::any_of(shared.prepared.notes.begin(), shared.prepared.notes.end(),
                      [&](const std::string& n) { return n.find(note) != std::string::npos; }));
    double worst = 0.0;
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const ObjectId id = world.copies[c].object;
        const Placed here = place_of(world, id), there = place_of(each.prepared.world, id);
        REQUIRE(here.facets == there.facets);
        // The facet in the same place.
        std::vector<std::uint32_t> same(here.facets);
        for (std::uint32_t k = 0; k < here.facets; ++k) {
            const Eigen::Vector3f at =
                (here.pose * world.facets.centroid[here.first + k].cast<double>()).cast<float>();
            float least = 1e9f;
            for (std::uint32_t f = there.first; f < there.first + there.facets; ++f) {
                const float far = (each.prepared.world.facets.centroid[f] - at).norm();
                if (far < least) least = far, same[k] = f;
            }
            REQUIRE(least < 2e-3f);
        }
        for (int hour = 0; hour < 24; ++hour) {
            const Instant when = later(parse_instant("2026-07-15T00:00:00-04:00"), 3600.0 * hour);
            const std::vector<float> a = shared.result.temperature.interpolate(when),
                                     b = each.result.temperature.interpolate(when);
            double sum = 0.0, area = 0.0;
            for (std::uint32_t k = 0; k < here.facets; ++k) {
                const double part = world.facets.area[here.first + k];
                sum += part * std::abs(a[here.first + k] - b[same[k]]);
                area += part;
            }
            worst = std::max(worst, sum / area);
        }
    }
    // Mean over the surface at the worst hour.
    CAPTURE(worst);
    CHECK(worst <= alike_within);
    CHECK(worst > 0.0);
}

TEST_CASE("pictures and labels of copies are those of objects built out", "[scenes][copies]") {
    const ScratchFolder folder("copies_pictures");
    const auto run = [&](const std::string& name, const std::string& objects) {
        const fs::path file = written(folder.path / name, objects);
        run_job(
            read_scene(file),
            {.out = folder.path / name / "out", .settings = {}, .progress = ProgressStyle::silent});
        return folder.path / name / "out";
    };
    const fs::path shared = run("shared", copies(alike_within)), each = run("apart", copies(0.0));
    for (const char* hour : {"13", "18"}) {
        const std::string picture = fmt::format("frames/mast_8-12_20260715T{}0000Z.exr", hour);
        const std::vector<std::string> planes{"object",
                                              "range",
                                              "normal.X",
                                              "normal.Y",
                                              "normal.Z",
                                              "temperature",
                                              "apparent_temperature.8-12"};
        const Frame a = read_exr(shared / picture, planes), b = read_exr(each / picture, planes);
        const std::vector<float>&id = a["object"].pixel, &other_id = b["object"].pixel;
        std::size_t other = 0, turned = 0, far = 0, on = 0;
        std::map<int, std::array<double, 3>> warmer;  // by object: pixels, Σ temperature, apparent
        double ground = 0.0, ground_pixels = 0.0;
        for (std::size_t p = 0; p < id.size(); ++p) {
            if (id[p] != other_id[p]) {
                ++other;
                continue;
            }
            const double apparent = std::abs(a["apparent_temperature.8-12"].pixel[p] -
                                             b["apparent_temperature.8-12"].pixel[p]);
            if (id[p] < 2.0f) {
                ground += apparent;
                ground_pixels += 1.0;
                continue;
            }
            ++on;
            far += std::abs(a["range"].pixel[p] - b["range"].pixel[p]) > 2e-3f;
            double apart = 0.0;
            for (const char* n : {"normal.X", "normal.Y", "normal.Z"}) {
                apart = std::max(apart, double(std::abs(a[n].pixel[p] - b[n].pixel[p])));
            }
            turned += apart > 1e-4;
            auto& sum = warmer[int(id[p])];
            sum[0] += 1.0;
            sum[1] += std::abs(a["temperature"].pixel[p] - b["temperature"].pixel[p]);
            sum[2] += apparent;
        }
        CAPTURE(hour, other, on, turned, far, ground / ground_pixels);
        CHECK(on > 1500);
        CHECK(other < 10);
        CHECK(far < 5);
        CHECK(turned < on / 200);  // at edges the neighbour's
        CHECK(warmer.size() == stands.size());
        CHECK(ground / ground_pixels < 0.1);
        double worst = 0.0;
        for (const auto& [object, sum] : warmer) {
            worst = std::max({worst, sum[1] / sum[0], sum[2] / sum[0]});
        }
        CAPTURE(worst);
        CHECK(worst < alike_within);
    }
    const auto labels = [](const fs::path& out) {
        const auto file = nlohmann::json::parse(read_text(out / "annotations.json"));
        std::vector<nlohmann::json> all;
        for (const auto& one : file["annotations"]) all.push_back(one);
        return all;
    };
    const std::vector<nlohmann::json> a = labels(shared), b = labels(each);
    REQUIRE(a.size() == b.size());
    CHECK(a.size() >= 4 * (stands.size() - 1));
    for (std::size_t i = 0; i < a.size(); ++i) {
        CAPTURE(a[i].dump());
        for (const char* key : {"image_id", "category_id", "instance", "iscrowd"}) {
            CHECK(a[i][key] == b[i][key]);
        }
        const auto near = [&](const nlohmann::json& one, const nlohmann::json& other,
                              double margin) {
            CHECK(one.get<double>() == Approx(other.get<double>()).margin(margin));
        };
        for (std::size_t k = 0; k < 4; ++k) {
            near(a[i]["bbox"][k], b[i]["bbox"][k], 1.0);
            near(a[i]["amodal_bbox"][k], b[i]["amodal_bbox"][k], 0.01);
        }
        for (const char* key : {"occlusion", "truncation"}) near(a[i][key], b[i][key], 0.02);
        near(a[i]["range_m"], b[i]["range_m"], 0.002);
        for (const char* key : {"azimuth_deg", "elevation_deg"}) {
            near(a[i]["aspect"][key], b[i]["aspect"][key], 0.01);
        }
    }
}

TEST_CASE("copies of their own each are the objects built out", "[scenes][copies]") {
    const ScratchFolder folder("copies_exact");
    // So far apart that each has the patch of ground that an object has.
    const std::vector<Stand> far{{0.0, 0.0, 20.0}, {50.0, 3.0, 20.0}, {0.0, 45.0, 100.0}};
    const Solved own = solved(folder.path / "own", copies(0.0, far));
    const Solved each = solved(folder.path / "apart", apart(far));
    CHECK(own.prepared.world.copies.empty());
    CHECK(own.prepared.world.objects == each.prepared.world.objects);
    REQUIRE(own.prepared.world.facets.size() == each.prepared.world.facets.size());
    const Instant noon = parse_instant("2026-07-15T12:00:00-04:00");
    CHECK(own.result.temperature.interpolate(noon) == each.result.temperature.interpolate(noon));
}

TEST_CASE("a roof over a copy changes temperatures as computed by hand",
          "[scenes][copies][by_comparison]") {
    const ScratchFolder folder("copies_roof");
    const auto slab = [](double half, double thick) {
        std::string text;
        for (const double z : {0.0, thick}) {
            for (const auto& [x, y] :
                 {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
                text += fmt::format("v {} {} {}\n", x, y, z);
            }
        }
        return text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    };
    write_text(folder.path / "plate.obj", slab(1.0, 0.05));
    write_text(folder.path / "roof.obj", slab(100.0, 0.2));
    const std::string rest = "up = \"z\"\nmaterial = \"painted_sheet\"\nlargest_edge_m = 50.0\n";
    const Prepared built = prepare(read_scene(
        written(folder.path,
                "[[object]]\nname = \"plate\"\nmesh = \"plate.obj\"\nheight_above_ground_m = 0.5\n"
                "copies = [[0.0, 0.0, 0.0], [250.0, 0.0, 0.0], [-250.0, 0.0, 0.0]]\n"
                "copies_alike_K = 0.0\nground_edge_m = 1.0\n" +
                    rest +
                    "[[object]]\nname = \"roof\"\nmesh = \"roof.obj\"\nplace_m = [0.0, 0.0]\n"
                    "height_above_ground_m = 3.0\nground_edge_m = 50.0\n" +
                    rest)));
    const Placed plate = place_of(built.world, ObjectId{2});
    const SurroundingsSampler sampler(built.world, built.scene, plate.first, plate.facets,
                                      Stance{});
    const auto at = [&](double east, double heading_deg) {
        return sampler.at(built.rays, Eigen::Isometry3d(Eigen::Translation3d(east, 0.0, 0.0)),
                          Stance{.heading_deg = heading_deg}, 1.0f);
    };
    const Surroundings under = at(0.0, 0.0), east = at(250.0, 0.0), west = at(-250.0, 0.0);
    const double any = 1e3;
    CHECK(sampler.apart(east, west, any).mean < 0.1);
    CHECK(std::isinf(sampler.apart(east, at(-250.0, 6.0), any).mean));
    // On its upper face at noon: declination of 15 July 21.5 degrees (Cooper 1969), the beam of
    // Meinel & Meinel at an air mass of 1 / sin 75.2 degrees, less 150 W/m2 of the sky it loses.
    const double absorptance =
        1.0 - built.scene.materials[built.scene.materials.find("painted_sheet")].thermal.albedo;
    const double rise = std::sin((90.0 - 36.32 + 21.5) * 3.141592653589793 / 180.0);
    const double beam = 1353.0 * std::pow(0.7, std::pow(1.0 / rise, 0.678));
    const double expected = (absorptance * beam * rise - 150.0) / 8.3;
    const auto apart_by = sampler.apart(under, east, any);
    CAPTURE(absorptance, expected, apart_by.mean);
    CHECK(apart_by.worst == Approx(expected).epsilon(0.01));
    CHECK(apart_by.mean < apart_by.worst);
    CHECK(apart_by.mean > 0.4 * apart_by.worst);  // the upper face is 4 of 8.4 m2
    CHECK(std::isinf(sampler.apart(under, east, 0.9 * apart_by.mean).mean));
}
