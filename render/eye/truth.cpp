#include "render/eye/truth.hpp"

#include <cmath>
#include <limits>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

/// (pixel) [K] what its centre's facet is warmer there; empty: nothing anywhere.
std::vector<float> warmer_centres(const View& view, const PixelSun* sun,
                                  const LinearFacets* ground) {
    std::vector<float> warmer;
    if (ground != nullptr) warmer = ground->warmer_centre;
    if (sun == nullptr || sun->warmer.empty()) return warmer;
    warmer.resize(view.pixels(), 0.0f);
    std::vector<float> in_sun(view.pixels(), 0.0f);
    for (std::size_t k = 0; k < sun->pixel.size(); ++k) {
        const std::size_t p = sun->pixel[k];
        const SurfaceId centre = view.surfaces_at(p).first;
        for (std::uint32_t e = sun->row[k]; e < sun->row[k + 1]; ++e) {
            const std::uint32_t target = view.sighting[sun->sighting[e]].target;
            if (view.surface[target] == centre && view.copy_of(target) == view.copy_at(p)) {
                in_sun[p] = sun->warmer[e];
            }
        }
    }
    for (std::size_t p = 0; p < warmer.size(); ++p) warmer[p] += in_sun[p];
    return warmer;
}

}  // namespace

void add_truth(const View& view, const RadianceInput& input, const PixelSun* sun,
               const LinearFacets* ground, Frame& frame) {
    const std::vector<float> warmer = warmer_centres(view, sun, ground);
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    const FacetSet& facets = input.facets;
    const auto add_pixels = [&](const char* name, const char* unit, float sky, const auto& value) {
        Plane plane{name, unit, std::vector<float>(view.pixels(), sky)};
        for_each_index(
            view.pixels(),
            [&](std::size_t p) {
                if (view.centre[p] != no_facet) plane.pixel[p] = static_cast<float>(value(p));
            },
            8192);
        frame.planes.push_back(std::move(plane));
    };
    const auto add = [&](const char* name, const char* unit, float sky, const auto& value) {
        add_pixels(name, unit, sky, [&](std::size_t p) { return value(index(view.centre[p])); });
    };
    // Of a textured facet: what is there, and in which of its materials most of that is.
    add_pixels("temperature", "K", nothing, [&](std::size_t p) {
        const Blend b = view.surfaces_at(p);
        const double more = warmer.empty() ? 0.0 : double{warmer[p]};
        const double first = more + input.temperature[index(b.first)];
        if (b.second_share == 0.0f) return first;
        const double second = more + input.temperature[index(b.second)];
        const auto fourth = [](double x) { return (x * x) * (x * x); };
        return std::sqrt(
            std::sqrt(std::lerp(fourth(first), fourth(second), double{b.second_share})));
    });
    frame.planes.push_back({"range", "m", view.centre_range});
    add("facet", "1", -1.0f, [&](std::size_t f) { return f; });
    add_pixels("object", "1", -1.0f,
               [&](std::size_t p) { return static_cast<unsigned>(view.object_at(facets, p)); });
    add_pixels("material", "1", -1.0f, [&](std::size_t p) {
        const Blend b = view.surfaces_at(p);
        return index(facets.material[index(b.second_share > 0.5f ? b.second : b.first)]);
    });
    const auto normal = [&](std::size_t p) -> Eigen::Vector3f {
        const Eigen::Vector3f& own = facets.normal[index(view.centre[p])];
        const std::uint32_t copy = view.copy_at(p);
        if (copy == no_copy) return own;
        return view.copies.turned(copy, own.cast<double>()).cast<float>();
    };
    add_pixels("normal.X", "1", nothing, [&](std::size_t p) { return normal(p).x(); });
    add_pixels("normal.Y", "1", nothing, [&](std::size_t p) { return normal(p).y(); });
    add_pixels("normal.Z", "1", nothing, [&](std::size_t p) { return normal(p).z(); });
}

}  // namespace diurna
