#pragma once

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/files.hpp"
#include "tests/support/sheet_scene.hpp"

// A box with parts as a target over a plain, solved for a day.

namespace diurna::testing::target_scene {

/// A closed box with a group for each of lid, floor and sides; in squares of a metre.
inline std::string box(int size, double thick) {
    std::string text;
    int n = 0;
    const double half = 0.5 * size;
    const auto quad = [&](std::array<Eigen::Vector3d, 4> v) {
        for (const auto& p : v) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
        text += fmt::format("f {} {} {} {}\n", n + 1, n + 2, n + 3, n + 4);
        n += 4;
    };
    for (const bool lid : {true, false}) {
        text += lid ? "g lid\n" : "g floor\n";
        for (double a = -half; a < half; a += 1.0) {
            for (double c = -half; c < half; c += 1.0) {
                const double b = a + 1.0, d = c + 1.0;
                if (lid) {
                    quad({{{a, c, thick}, {b, c, thick}, {b, d, thick}, {a, d, thick}}});
                } else {
                    quad({{{a, d, 0}, {b, d, 0}, {b, c, 0}, {a, c, 0}}});
                }
            }
        }
    }
    text += "g sides\n";
    for (double a = -half; a < half; a += 1.0) {
        const double b = a + 1.0, h = half, z = thick;
        quad({{{a, -h, 0}, {b, -h, 0}, {b, -h, z}, {a, -h, z}}});
        quad({{{b, h, 0}, {a, h, 0}, {a, h, z}, {b, h, z}}});
        quad({{{-h, b, 0}, {-h, a, 0}, {-h, a, z}, {-h, b, z}}});
        quad({{{h, a, 0}, {h, b, 0}, {h, b, z}, {h, a, z}}});
    }
    return text;
}

struct Solved {
    Prepared prepared;
    SpanResult result;

    /// Mean by area of the facets of a mesh's part at an instant [K].
    double kelvin(const std::string& time, const std::string& part) const {
        const std::vector<float> all =
            result.temperature.interpolate(parse_instant("2026-03-20T" + time + ":00Z"));
        const FacetSet& facets = prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = prepared.world.ground_facets; f < facets.size(); ++f) {
            const std::string& name = prepared.scene.materials[facets.material[f]].name;
            if (name.find(" " + part) == std::string::npos) continue;
            sum += double(facets.area[f]) * double(all[f]);
            area += double(facets.area[f]);
        }
        REQUIRE(area > 0.0);
        return sum / area;
    }
};

inline Solved solved(const over_plain::Given& given, const std::string& tables, double hours = 24.0,
                     double largest_edge = 2.0, const std::string& of_time = "",
                     const std::string& more = "") {
    const ScratchFolder folder("target");
    over_plain::write_scene(folder.path, given);
    std::string text = read_text(folder.path / "scene.toml");
    const std::string end = "material = \"sheet\"\n";
    text.insert(text.rfind(end) + end.size(), tables);
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    put("largest_edge_m = 2.0", fmt::format("largest_edge_m = {}", largest_edge));
    put("object_sky_rays = 1024", "object_sky_rays = 64");
    put("sky_rays = 1024", "sky_rays = 64");
    put("interval = \"instant\"", "interval = \"instant\"\nlapse = 0.0");
    const std::string start = "start = 2026-03-20T00:00:00Z\n";
    text.insert(text.find(start) + start.size(),
                fmt::format("duration_h = {}\n{}", hours, of_time));
    write_text(folder.path / "scene.toml", text + more);
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(result)};
}

}  // namespace diurna::testing::target_scene
