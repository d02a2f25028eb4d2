#include "scenes/job/world/rain_cover.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

#include "materials/base/number_of.hpp"
#include "materials/matter/passed_light.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"

namespace diurna {

namespace {

bool rains(const Weather& weather) {
    return std::any_of(weather.sample.begin(), weather.sample.end(),
                       [](const Forcing& f) { return f.rain_mm_h > 0.0; });
}

/// (material) What lets drops fall on, at any angle: nets.
std::vector<PassedLight> passed_rain(const MaterialLibrary& materials) {
    std::vector<PassedLight> all(materials.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        if (material.cover < 1.0) all[m].beam.assign(2, static_cast<float>(1.0 - material.cover));
    }
    return all;
}

/// Buildings and objects, and the ground that has some of them above its bounding square.
std::vector<std::uint32_t> maybe_covered(const World& world) {
    const FacetSet& facets = world.facets;
    const auto grow = [&](std::size_t f, Eigen::AlignedBox2f& box) {
        for (const std::uint32_t v : facets.corner[f]) box.extend(facets.vertex[v].head<2>());
    };
    Eigen::AlignedBox2f bodies;
    for (std::size_t f = world.ground_facets; f < facets.size(); ++f) grow(f, bodies);
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Eigen::AlignedBox3f box = world.copies.box(facets, c).cast<float>();
        bodies.extend(Eigen::AlignedBox2f(box.min().head<2>(), box.max().head<2>()));
    }
    std::vector<std::uint32_t> chosen;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        Eigen::AlignedBox2f own;
        grow(f, own);
        if (f >= world.ground_facets || bodies.intersects(own)) {
            chosen.push_back(static_cast<std::uint32_t>(f));
        }
    }
    return chosen;
}

}  // namespace

std::vector<float> open_above(const World& world, const MaterialLibrary& materials,
                              const Weather& weather) {
    if (world.ground_facets >= world.facets.size() || !rains(weather)) return {};
    const RayScene rays(world.facets, passed_rain(materials), world.copies);
    std::vector<float> open(world.facets.size(), 1.0f);
    // The zenith as a sun: what its beam reaches, drops do.
    sun_fraction(world.facets, rays, Eigen::Vector3d::UnitZ(), maybe_covered(world), open,
                 {.samples = 16});
    return world.texture_levels.empty() ? open : for_all_levels(world.texture_levels, open);
}

std::string rain_note(const World& world, const MaterialLibrary& materials, const Weather& weather,
                      const std::vector<float>& open) {
    if (!rains(weather)) return "";
    const FacetSet& surfaces = world.surfaces();
    std::size_t covered = 0, flying = 0;
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        if (materials[surfaces.material[f]].thermal.flight) {
            ++flying;
        } else if (!open.empty() && surfaces.normal[f].z() > 0.0f && open[f] < 1.0f) {
            ++covered;
        }
    }
    std::string note;
    if (covered > 0) {
        note = fmt::format(
            "rain and snow fall vertically: {} wholly or partly under roofs, panes or nets and "
            "receive only what those let through",
            number_of(covered, "upward facet is", "upward facets are"));
    }
    if (flying > 0) {
        note += fmt::format("{}{} in flight and without rain or snow",
                            note.empty() ? "rain and snow: " : "; ",
                            number_of(flying, "facet is", "facets are"));
    }
    return note;
}

}  // namespace diurna
