#include "scenes/job/plan/followed_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "materials/base/random.hpp"
#include "materials/matter/waves.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/rays/lobe.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/place_in_picture.hpp"
#include "scenes/job/plan/seen_pixels.hpp"

namespace diurna {

namespace {

constexpr double most_pixels = 1e6;  // of a picture in which they are looked for
// [K] of a facet without sun, and what the sun adds to a black one that faces it and is dry, and
// to a moist one.
constexpr float shaded = 288.0f, by_the_sun = 25.0f, to_moist = 0.4f;

/// A facet that may send rays on, at its place.
struct Candidate {
    std::array<Eigen::Vector3d, 3> corner;
    std::uint32_t facet = 0;
    double pixels = 0.0;
};

std::vector<Candidate> candidates(const Scene& scene, const World& world, const Observer& pose) {
    std::vector<bool> needs(scene.materials.size());
    for (std::size_t i = 0; i < needs.size(); ++i) {
        needs[i] = scene.materials[MaterialId{static_cast<std::uint16_t>(i)}].needs_rays();
    }
    std::vector<Candidate> found;
    if (std::find(needs.begin(), needs.end(), true) == needs.end()) return found;
    const PosedCamera camera(pose);
    const FacetSet& facets = world.facets;
    const auto add = [&](std::size_t f, const Eigen::Isometry3d& placed) {
        if (!needs[index(facets.material[f])]) return;
        const double pixels =
            camera.pixels_of(placed * facets.centroid[f].cast<double>(),
                             placed.linear() * facets.normal[f].cast<double>(), facets.area[f]);
        if (!(pixels > 0.0)) return;
        Candidate one{.corner = {}, .facet = static_cast<std::uint32_t>(f), .pixels = pixels};
        for (std::size_t c = 0; c < 3; ++c) {
            one.corner[c] = placed * facets.vertex[facets.corner[f][c]].cast<double>();
        }
        found.push_back(one);
    };
    for (std::size_t f = 0; f < facets.size(); ++f) add(f, Eigen::Isometry3d::Identity());
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        for (std::uint32_t f = copy.first; f < copy.first + copy.facets; ++f) {
            add(f, Eigen::Isometry3d(copy.pose));
        }
    }
    return found;
}

/// A point of a triangle, by two numbers in [0, 1).
Eigen::Vector3d point_of(const Candidate& one, double u, double v) {
    const double root = std::sqrt(u);
    return (1.0 - root) * one.corner[0] + root * (1.0 - v) * one.corner[1] +
           root * v * one.corner[2];
}

/// A point of a facet, in a pixel.
struct Pick {
    std::size_t pixel;
    std::uint32_t facet;
};

/// Evenly over the pixels that facets fill.
std::vector<Pick> picks(const std::vector<Candidate>& facets, double pixels, const Observer& pose,
                        const FollowedOptions& options, std::uint64_t seed) {
    const PixelRays eye = pixel_rays(pose);
    RandomStream chance{seed};
    std::vector<Pick> found;
    std::size_t at = 0;
    double before = 0.0;  // pixels of facets before `at`
    for (std::size_t k = 0; k < options.looked_at; ++k) {
        const double sought = (double(k) + 0.5) / double(options.looked_at) * pixels;
        while (at + 1 < facets.size() && before + facets[at].pixels < sought) {
            before += facets[at++].pixels;
        }
        const double u = chance(), v = chance();
        const auto place = place_in_picture(pose, eye, point_of(facets[at], u, v));
        if (!place || place->x() < 0.0 || place->y() < 0.0 || place->x() >= pose.width ||
            place->y() >= pose.height)
            continue;
        const auto column = static_cast<std::size_t>(place->x());
        const auto row = static_cast<std::size_t>(place->y());
        found.push_back({row * static_cast<std::size_t>(pose.width) + column, facets[at].facet});
    }
    return found;
}

/// Whether its pixel sees the facet, not only what is in front of it.
bool is_seen(const Pick& pick, const View& view, const World& world) {
    const auto first = view.sighting.begin() + view.row[pick.pixel],
               last = view.sighting.begin() + view.row[pick.pixel + 1];
    return std::any_of(first, last, [&](const Sighting& sighting) {
        const SurfaceId surface = view.surface[sighting.target];
        return index(world.texture_levels.facet_of(surface)) == pick.facet;
    });
}

/// (pixel) some of the picked ones and those about them: lobes that meet facets have more rays,
/// also in the pixels about one where they do.
std::vector<std::uint8_t> blocks_around(const std::vector<Pick>& picked, const Observer& pose,
                                        std::size_t most) {
    std::vector<std::uint8_t> asked(static_cast<std::size_t>(pose.width) * pose.height, 0);
    const auto width = static_cast<std::size_t>(pose.width);
    const std::size_t count = std::min(most, picked.size());
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t pixel = picked[(2 * k + 1) * picked.size() / (2 * count)].pixel;
        const auto column = int(pixel % width), row = int(pixel / width);
        for (int r = std::max(0, row - 1); r <= std::min(pose.height - 1, row + 1); ++r) {
            for (int c = std::max(0, column - 1); c <= std::min(pose.width - 1, column + 1); ++c) {
                asked[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(c)] = 1;
            }
        }
    }
    return asked;
}

Appearance nominal(const FacetSet& surfaces, const MaterialLibrary& materials) {
    static const Eigen::Vector3f to_sun = Eigen::Vector3f(0.3f, -0.5f, 0.8f).normalized();
    std::vector<float> warmed;  // (material) [K]
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const ThermalSurface& surface =
            materials[MaterialId{static_cast<std::uint16_t>(i)}].thermal;
        const bool moist = surface.evaporation.wetness > 0.0;
        warmed.push_back(by_the_sun * static_cast<float>(1.0 - surface.albedo) *
                         (moist ? to_moist : 1.0f));
    }
    Appearance look;
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        look.facet.push_back(shaded + warmed[index(surfaces.material[f])] *
                                          std::max(0.0f, surfaces.normal[f].dot(to_sun)));
    }
    return look;
}

/// The camera with as many pixels as are looked through.
Observer coarser(Observer pose, double& times) {
    const double pixels = double(pose.width) * pose.height;
    if (pixels <= most_pixels) return pose;
    const double by = std::sqrt(pixels / most_pixels);
    pose.width = std::max(1, static_cast<int>(pose.width / by));
    pose.height = std::max(1, static_cast<int>(pose.height / by));
    times = pixels / (double(pose.width) * pose.height);
    return pose;
}

}  // namespace

FollowedRays followed_rays(const Scene& scene, const World& world, const RayScene& rays,
                           const Observer& pose, const FollowedOptions& options) {
    double times = 1.0;
    const Observer camera = coarser(pose, times);
    const std::vector<Candidate> facets = candidates(scene, world, camera);
    double pixels = 0.0;
    for (const Candidate& one : facets) pixels += one.pixels;
    if (!(pixels > 0.0)) return {};
    const std::vector<Pick> picked = picks(facets, pixels, camera, options, scene.seed);
    const auto all_pixels = static_cast<std::size_t>(camera.width) * camera.height;
    std::vector<std::uint8_t> asked(all_pixels, 0);
    for (const Pick& pick : picked) asked[pick.pixel] = 1;
    const FacetSet& surfaces = world.surfaces();
    ViewOptions sampling{.samples = options.samples,
                         .seed = scene.seed,
                         .texture_levels = &world.texture_levels,
                         .asked = asked};
    View view = cast_view(rays, surfaces, camera, sampling);
    std::vector<Pick> seen;
    std::copy_if(picked.begin(), picked.end(), std::back_inserter(seen),
                 [&](const Pick& pick) { return is_seen(pick, view, world); });
    if (seen.empty()) return {};
    const std::vector<std::uint8_t> blocks = blocks_around(seen, camera, options.blocks);
    sampling.asked = blocks;
    view = cast_view(rays, surfaces, camera, sampling);
    const Appearance look = nominal(surfaces, scene.materials);
    std::optional<SecondarySampling> by_need;
    if (options.by_need) by_need = SecondarySampling{*options.by_need, {&look, 1}};
    const PlumeScene no_plumes({});
    const SecondaryRays found = follow_rays(view,
                                            {.rays = rays,
                                             .facets = surfaces,
                                             .materials = scene.materials,
                                             .plumes = no_plumes,
                                             .wind_speed = options.wind_speed},
                                            camera, sampling, by_need ? &*by_need : nullptr);
    if (found.pixel.empty()) return {};
    const double all =
        times * std::min(pixels * double(seen.size()) / double(picked.size()), double(all_pixels));
    const double each = all / double(found.pixel.size());
    const auto in_lobes = std::count_if(seen.begin(), seen.end(), [&](const Pick& pick) {
        const Material& material = scene.materials[world.facets.material[pick.facet]];
        return roughness_under(material.finish, options.wind_speed) >= least_lobe;
    });
    return {.pixels = all,
            .in_lobes = all * double(in_lobes) / double(seen.size()),
            .rays = each * double(found.rays),
            .secondary = each * double(found.secondary.size())};
}

}  // namespace diurna
