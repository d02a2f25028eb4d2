#include "render/rays/follow_rays.hpp"

#include <algorithm>
#include <optional>

#include "materials/base/parallel.hpp"
#include "materials/matter/waves.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/pixel_walks.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/textured_hit.hpp"

namespace diurna {

namespace {

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

std::vector<AskedPixel> special_pixels(const View& view, const SecondaryScene& scene,
                                       const Observer& observer, const PixelRays& eye) {
    std::vector<AskedPixel> pixels;
    const std::vector<bool> target = targets_that_need_rays(view, scene);
    const auto spheres = scene.plumes.spheres();
    if (spheres.empty() && std::find(target.begin(), target.end(), true) == target.end()) {
        return pixels;
    }
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        if (near_plume(p, eye, observer, spheres)) {
            pixels.push_back({static_cast<std::uint32_t>(p)});
            continue;
        }
        bool found = false;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1] && !found; ++k) {
            found = target[view.sighting[k].target];
        }
        if (!found) continue;
        pixels.push_back({static_cast<std::uint32_t>(p), pixel_shares(view, p, scene, eye)});
    }
    return pixels;
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
std::vector<bool> near_in_lobes(std::span<const AskedPixel> pixels, std::size_t width,
                                std::span<const WalkedPixel> found, const SecondaryScene& scene) {
    std::vector<std::uint32_t> met;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (meets_in_lobe(found[k].seen, scene)) met.push_back(pixels[k].pixel);
    }
    std::vector<bool> near(pixels.size(), false);
    const auto mark = [&](std::size_t pixel) {
        const auto at = std::lower_bound(
            pixels.begin(), pixels.end(), pixel,
            [](const AskedPixel& asked, std::size_t sought) { return asked.pixel < sought; });
        if (at != pixels.end() && at->pixel == pixel) near[std::size_t(at - pixels.begin())] = true;
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
    const PixelRays eye = pixel_rays(observer);
    const std::vector<AskedPixel> asked = special_pixels(view, scene, observer, eye);
    if (asked.empty()) return secondary_rays;

    std::optional<TexturedHit> textured;
    SecondaryScene with_textures = scene;
    if (options.texture_levels != nullptr && !options.texture_levels->empty()) {
        textured.emplace(*options.texture_levels, observer, options.samples);
        with_textures.textured = &*textured;
    }
    const PixelWalks walks{with_textures, observer, eye, options, sampling};
    std::vector<WalkedPixel> found(asked.size());
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
            WalkedPixel more = walks.all(asked[k], wanted[k], near[k]);
            found[k].rays += more.rays;
            if (!more.seen.empty()) found[k].seen = std::move(more.seen);
        },
        16);
    for (std::size_t k = 0; k < found.size(); ++k) {
        secondary_rays.rays += found[k].rays;
        const std::vector<SecondaryRay>& seen = found[k].seen;
        if (seen.empty()) continue;
        secondary_rays.pixel.push_back(asked[k].pixel);
        secondary_rays.secondary.insert(secondary_rays.secondary.end(), seen.begin(), seen.end());
        secondary_rays.row.push_back(static_cast<std::uint32_t>(secondary_rays.secondary.size()));
    }
    take_out(secondary_rays.pixel, view);
    return secondary_rays;
}

}  // namespace diurna
