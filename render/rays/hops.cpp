#include "render/rays/hops.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "render/rays/merge.hpp"
#include "render/rays/walk.hpp"

namespace diurna {

namespace {

/// Pixels that see a material that needs rays, or whose middle passes a plume's sphere.
std::vector<std::uint32_t> special_pixels(const View& view, const FacetSet& facets,
                                          const MaterialLibrary& materials,
                                          const PlumeScene& plumes, const Observer& observer) {
    std::vector<bool> special(materials.size());
    bool any = false;
    for (std::size_t m = 0; m < special.size(); ++m) {
        special[m] = materials[MaterialId{static_cast<std::uint16_t>(m)}].needs_rays();
        any = any || special[m];
    }
    std::vector<std::uint32_t> pixels;
    if (!any && plumes.spheres().empty()) return pixels;
    std::vector<bool> target(view.facet.size());
    for (std::size_t t = 0; t < target.size(); ++t) {
        target[t] = special[index(facets.material[index(view.facet[t])])];
    }
    const PixelRays rays = pixel_rays(observer);
    const auto width = static_cast<std::size_t>(view.width);
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        bool found = false;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1] && !found; ++k) {
            found = target[view.sighting[k].target];
        }
        const double column = double(p % width) + 0.5, row = double(p / width) + 0.5;
        for (const PlumeScene::Sphere& sphere : plumes.spheres()) {
            if (found) break;
            const Eigen::Vector3d from = observer.position + rays.start(column, row);
            const Eigen::Vector3d to = rays.towards(column, row);
            const double along = std::max(0.0, (sphere.middle - from).dot(to));
            // A pixel's corner lies at most its diagonal away.
            const double pixel =
                along * (rays.towards(column + 0.5, row + 0.5) - to).norm() +
                (rays.start(column + 0.49, row + 0.49) - rays.start(column, row)).norm() +
                0.5 * rays.exposure_way.norm();
            found = (from + along * to - sphere.middle).norm() < sphere.radius + 1.1 * pixel;
        }
        if (found) pixels.push_back(static_cast<std::uint32_t>(p));
    }
    return pixels;
}

}  // namespace

Hops follow_rays(View& view, const RayScene& scene, const FacetSet& facets,
                 const MaterialLibrary& materials, const PlumeScene& plumes,
                 const Observer& observer, const ViewOptions& options) {
    Hops hops;
    hops.pixel = special_pixels(view, facets, materials, plumes, observer);
    hops.row.assign(1, 0);
    if (hops.pixel.empty()) return hops;

    const PixelRays eye = pixel_rays(observer);
    const auto [columns, rows] = nearly_square(options.samples);
    const bool textured = options.texture_levels != nullptr && !options.texture_levels->empty();
    const HopScene place{scene,
                         facets,
                         materials,
                         plumes,
                         observer,
                         textured ? options.texture_levels : nullptr,
                         sample_angle(observer, options.samples)};
    std::vector<std::vector<Hop>> found(hops.pixel.size());
    for_each_index(
        hops.pixel.size(),
        [&](std::size_t k) {
            const std::size_t p = hops.pixel[k], width = static_cast<std::size_t>(view.width);
            std::vector<Hop> sample, seen;
            const double offset = RandomStream{(options.seed << 32) + p}();
            for (int s = 0; s < options.samples; ++s) {
                RandomStream chance{(options.seed * golden_step) ^
                                    ((std::uint64_t{p} << 16) + std::uint64_t(s)) * second_step};
                const double x = chance(), y = chance();
                const double column = double(p % width) + (s % columns + x) / columns;
                const double row = double(p / width) + (double(s / columns) + y) / rows;
                sample.clear();
                const double when = exposed(std::size_t(s), offset);
                walk(place, observer.position + eye.start(column, row, when),
                     eye.towards(column, row), 1.0f / static_cast<float>(options.samples), chance,
                     sample);
                add_sample(sample, plumes, seen);
            }
            // Past the plumes after all: the view has it already.
            const bool plain = std::all_of(seen.begin(), seen.end(), [](const Hop& hop) {
                return hop.before < 0 && !hop.closed && hop.kind != Hop::Kind::plume;
            });
            if (!plain) found[k] = std::move(seen);
        },
        16);
    std::vector<bool> taken(view.pixels(), false);
    const std::vector<std::uint32_t> asked = std::move(hops.pixel);
    hops.pixel.clear();
    hops.row.assign(1, 0);
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k].empty()) continue;
        hops.pixel.push_back(asked[k]);
        hops.hop.insert(hops.hop.end(), found[k].begin(), found[k].end());
        hops.row.push_back(static_cast<std::uint32_t>(hops.hop.size()));
        taken[asked[k]] = true;
        view.sky[asked[k]] = 0.0f;
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
    return hops;
}

std::vector<FacetId> facets_of(const Hops& hops) {
    std::vector<std::uint32_t> seen;
    for (const Hop& hop : hops.hop) {
        if (hop.kind == Hop::Kind::facet) seen.push_back(hop.what);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<FacetId> facets;
    for (const std::uint32_t f : seen) facets.push_back(FacetId{f});
    return facets;
}

}  // namespace diurna
