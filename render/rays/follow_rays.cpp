#include "render/rays/follow_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "materials/base/parallel.hpp"
#include "materials/matter/microfacet.hpp"
#include "materials/matter/waves.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/merge.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/textured_hit.hpp"

namespace diurna {

namespace {

double fraction(double x) { return x - std::floor(x); }

/// (target of the view) whether its material needs rays.
std::vector<bool> targets_that_need_rays(const View& view, const SecondaryScene& scene) {
    std::vector<bool> target(view.surface.size());
    for (std::size_t t = 0; t < target.size(); ++t) {
        target[t] = scene.needs_rays(view.surface[t]);
    }
    return target;
}

/// Whether some ray of a pixel may pass a plume: whether one through its middle comes near the
/// plume's sphere.
bool near_plume(std::size_t pixel, const PixelRays& rays, const Observer& observer,
                std::span<const PlumeScene::Sphere> spheres) {
    const auto width = static_cast<std::size_t>(observer.width);
    const double column = double(pixel % width) + 0.5, row = double(pixel / width) + 0.5;
    return std::any_of(spheres.begin(), spheres.end(), [&](const PlumeScene::Sphere& sphere) {
        const Eigen::Vector3d from = observer.position + rays.start(column, row);
        const Eigen::Vector3d to = rays.towards(column, row);
        const double along = std::max(0.0, (sphere.middle - from).dot(to));
        // A pixel's corner lies at most its diagonal away.
        const double diagonal =
            along * (rays.towards(column + 0.5, row + 0.5) - to).norm() +
            (rays.start(column + 0.49, row + 0.49) - rays.start(column, row)).norm() +
            0.5 * (rays.exposure_way.norm() + along * rays.exposure_turn.norm());
        return (from + along * to - sphere.middle).norm() < sphere.radius + 1.1 * diagonal;
    });
}

std::vector<std::uint32_t> special_pixels(const View& view, const SecondaryScene& scene,
                                          const Observer& observer) {
    std::vector<std::uint32_t> pixels;
    const std::vector<bool> target = targets_that_need_rays(view, scene);
    const auto spheres = scene.plumes.spheres();
    if (spheres.empty() && std::find(target.begin(), target.end(), true) == target.end()) {
        return pixels;
    }
    const PixelRays rays = pixel_rays(observer);
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        bool found = false;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1] && !found; ++k) {
            found = target[view.sighting[k].target];
        }
        if (found || near_plume(p, rays, observer, spheres)) {
            pixels.push_back(static_cast<std::uint32_t>(p));
        }
    }
    return pixels;
}

/// Rays of a pixel into lobes that meet things near by: as many as these, at most so many for each
/// sample. Those of a pixel are a lattice (golden_section): a straight edge's share of 64 is found
/// to 0.003.
constexpr int lobe_rays_of_pixel = 64, most_lobe_rays = 4;

/// The samples take the lattice's points in steps of this, so that those in one part of a pixel,
/// where a mirror's edge crosses it, spread over the whole lobe: of 256 half find a share to 0.014
/// rms, in the lattice's own order to 0.17 in the lower half. Near a quarter, prime to their
/// number.
int lattice_step(int samples) {
    int step = std::max(1, static_cast<int>(std::lround(samples * (std::sqrt(5.0) - 2.0))));
    while (std::gcd(step, samples) != 1) ++step;
    return step;
}

/// Whether a ray into a lobe met a facet.
bool meets_in_lobe(std::span<const SecondaryRay> secondary_rays, const SecondaryScene& scene) {
    return std::any_of(
        secondary_rays.begin(), secondary_rays.end(), [&](const SecondaryRay& secondary) {
            if (secondary.way != SecondaryRay::Way::mirrored ||
                secondary.kind != SecondaryRay::Kind::facet)
                return false;
            const SecondaryRay& mirror = secondary_rays[static_cast<std::size_t>(secondary.before)];
            const auto& finish = scene.material(mirror.surface()).finish;
            return roughness_under(finish, scene.wind_speed) >= least_lobe;
        });
}

/// (index among the pixels asked) whether lobes are to have more rays there: where one met a facet,
/// and the pixels about it, so that the choice depends little on chance.
std::vector<bool> near_in_lobes(std::span<const std::uint32_t> pixels, std::size_t width,
                                const std::vector<std::vector<SecondaryRay>>& found,
                                const SecondaryScene& scene) {
    std::vector<std::uint32_t> met;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (meets_in_lobe(found[k], scene)) met.push_back(pixels[k]);
    }
    std::vector<bool> near(pixels.size(), false);
    const auto mark = [&](std::size_t pixel) {
        const auto at = std::lower_bound(pixels.begin(), pixels.end(), pixel);
        if (at != pixels.end() && *at == pixel) near[std::size_t(at - pixels.begin())] = true;
    };
    for (const std::uint32_t p : met) {
        for (const std::ptrdiff_t down : {-1, 0, 1}) {
            for (const std::ptrdiff_t aside : {-1, 0, 1}) {
                const auto column = std::ptrdiff_t(p % width) + aside;
                const auto row = std::ptrdiff_t(p / width) + down;
                if (column < 0 || column >= std::ptrdiff_t(width) || row < 0) continue;
                mark(std::size_t(row) * width + std::size_t(column));
            }
        }
    }
    return near;
}

/// The rays of pixels, followed.
struct PixelWalks {
    const SecondaryScene& scene;
    const Observer& observer;
    const PixelRays& eye;
    const ViewOptions& options;
    const SecondarySampling* sampling;

    /// What a pixel's first samples meet, merged; empty where they meet what the view has already.
    /// And how many samples the pixel wants.
    std::vector<SecondaryRay> first(std::size_t p, int& wanted) const {
        wanted = sampling ? sampling->options.from : options.samples;
        if (sampling == nullptr) return walked(p, wanted, 1, options.seed, nullptr);
        std::vector<double> values;
        std::vector<SecondaryRay> seen = walked(p, wanted, 1, options.seed, &values);
        if (!seen.empty()) wanted = samples_wanted(values, *sampling);
        return seen;
    }

    /// What as many samples as it wants meet.
    ///
    /// - many: rays into lobes
    std::vector<SecondaryRay> all(std::size_t p, int samples, bool many) const {
        const int wanted = (lobe_rays_of_pixel + samples - 1) / samples;
        return walked(p, samples, many ? std::min(most_lobe_rays, wanted) : 1,
                      options.seed + golden_step, nullptr);
    }

 private:
    /// - values: what each sample shows; null: not requested
    std::vector<SecondaryRay> walked(std::size_t p, int samples, int lobe_rays, std::uint64_t seed,
                                     std::vector<double>* values) const {
        const auto [columns, rows] = nearly_square(samples);
        const auto width = static_cast<std::size_t>(observer.width);
        std::vector<SecondaryRay> sample, seen;
        RandomStream of_pixel{(seed << 32) + p};
        const double offset = of_pixel();
        const int step = lattice_step(samples);
        const std::array<double, 2> turn = {of_pixel(), of_pixel()};
        for (int s = 0; s < samples; ++s) {
            RandomStream chance{(seed * golden_step) ^
                                ((std::uint64_t{p} << 16) + std::uint64_t(s)) * second_step};
            const double x = chance(), y = chance();
            const double column = double(p % width) + (s % columns + x) / columns;
            const double row = double(p / width) + (double(s / columns) + y) / rows;
            const double when = exposed(std::size_t(s), offset);
            const int point = s * step % samples;
            sample.clear();
            walk(scene,
                 {.origin = observer.position + eye.start(column, row, when),
                  .direction = eye.towards(column, row, when),
                  .weight = 1.0f / static_cast<float>(samples),
                  .lobe = {.count = lobe_rays,
                           .first = {fraction(turn[0] + double(point) / (samples * lobe_rays)),
                                     fraction(turn[1] + point * golden_section)},
                           .step = {1.0 / lobe_rays, samples * golden_section}}},
                 chance, sample);
            if (values) sample_values(scene, sample, sampling->appearances, *values);
            add_sample(sample, scene.plumes, seen);
        }
        // Past the plumes after all?
        const bool plain =
            std::all_of(seen.begin(), seen.end(), [&](const SecondaryRay& secondary) {
                return secondary.before < 0 && !secondary.closed &&
                       secondary.kind != SecondaryRay::Kind::plume &&
                       !(secondary.kind == SecondaryRay::Kind::facet &&
                         scene.needs_rays(secondary.surface()));
            });
        if (plain) seen.clear();
        return seen;
    }
};

/// Takes what pixels see out of a view.
void take_out(std::span<const std::uint32_t> pixels, View& view) {
    std::vector<bool> taken(view.pixels(), false);
    for (const std::uint32_t p : pixels) {
        taken[p] = true;
        view.sky[p] = 0.0f;
    }
    std::uint32_t kept = 0, begin = 0;
    for (std::size_t p = 0; p < taken.size(); ++p) {
        const std::uint32_t end = view.row[p + 1];
        for (std::uint32_t i = begin; i < end && !taken[p]; ++i) {
            view.sighting[kept++] = view.sighting[i];
        }
        begin = end;
        view.row[p + 1] = kept;
    }
    view.sighting.resize(kept);
}

}  // namespace

SecondaryRays follow_rays(View& view, const SecondaryScene& scene, const Observer& observer,
                          const ViewOptions& options, const SecondarySampling* sampling) {
    SecondaryRays secondary_rays;
    secondary_rays.observer_height = view.observer_height;
    secondary_rays.row.assign(1, 0);
    const std::vector<std::uint32_t> asked = special_pixels(view, scene, observer);
    if (asked.empty()) return secondary_rays;

    std::optional<TexturedHit> textured;
    SecondaryScene with_textures = scene;
    if (options.texture_levels != nullptr && !options.texture_levels->empty()) {
        textured.emplace(*options.texture_levels, observer, options.samples);
        with_textures.textured = &*textured;
    }
    const PixelRays eye = pixel_rays(observer);
    const PixelWalks walks{with_textures, observer, eye, options, sampling};
    std::vector<std::vector<SecondaryRay>> found(asked.size());
    std::vector<int> wanted(asked.size());
    for_each_index(
        asked.size(), [&](std::size_t k) { found[k] = walks.first(asked[k], wanted[k]); }, 16);
    const int first = sampling ? sampling->options.from : options.samples;
    const std::vector<bool> near =
        near_in_lobes(asked, static_cast<std::size_t>(observer.width), found, with_textures);
    for_each_index(
        asked.size(),
        [&](std::size_t k) {
            if (!near[k] && wanted[k] <= first) return;
            found[k] = walks.all(asked[k], wanted[k], near[k]);
        },
        16);
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k].empty()) continue;
        secondary_rays.pixel.push_back(asked[k]);
        secondary_rays.secondary.insert(secondary_rays.secondary.end(), found[k].begin(),
                                        found[k].end());
        secondary_rays.row.push_back(static_cast<std::uint32_t>(secondary_rays.secondary.size()));
    }
    take_out(secondary_rays.pixel, view);
    return secondary_rays;
}

}  // namespace diurna
