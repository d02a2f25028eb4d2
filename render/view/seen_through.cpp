#include "render/view/seen_through.hpp"

#include "materials/base/parallel.hpp"
#include "render/view/pixel_rays.hpp"

namespace diurna {

std::vector<int> seen_through(const View& view, const RayScene& rays, const FacetSet& facets,
                              const Observer& observer, std::span<const double> passed,
                              double least) {
    const auto share = [&](FacetId f) { return passed[index(facets.material[index(f)])]; };
    std::vector<std::uint32_t> pixel;
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        if (view.centre[p] != no_facet && share(view.centre[p]) >= least) {
            pixel.push_back(static_cast<std::uint32_t>(p));
        }
    }
    if (pixel.empty()) return {};
    std::vector<int> behind(view.pixels(), -1);
    const PixelRays eye = pixel_rays(observer);
    constexpr int most_layers = 16;
    for_each_index(pixel.size(), [&](std::size_t k) {
        const std::size_t p = pixel[k], width = std::size_t(view.width);
        const double x = double(p % width) + 0.5, y = double(p / width) + 0.5;
        Ray ray{.origin = (observer.position + eye.start(x, y)).cast<float>(),
                .direction = eye.towards(x, y).cast<float>()};
        double left = share(view.centre[p]);
        float range = view.centre_range[p];
        for (int layer = 0; layer < most_layers && left >= least; ++layer) {
            ray.near = range * (1.0f + 1e-6f) + 1e-3f;
            Hit hit;
            rays.closest({&ray, 1}, {&hit, 1});
            if (hit.facet == no_facet) return;
            const ObjectId here = hit.copy == no_copy ? facets.object[index(hit.facet)]
                                                      : rays.copies()[hit.copy].object;
            if (here != view.object_at(facets, p)) {
                behind[p] = static_cast<int>(here);
                return;
            }
            left *= share(hit.facet);
            range = hit.range;
        }
    });
    return behind;
}

}  // namespace diurna
