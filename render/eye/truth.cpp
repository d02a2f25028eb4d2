#include "render/eye/truth.hpp"

#include <cmath>
#include <limits>

#include "materials/base/parallel.hpp"

namespace diurna {

void add_truth(const View& view, const RadianceInput& input, Frame& frame) {
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
    const auto blend = [&](std::size_t p) {
        return view.centre_blend.empty() ? Blend{view.centre[p], view.centre[p]}
                                         : view.centre_blend[p];
    };
    add_pixels("temperature", "K", nothing, [&](std::size_t p) {
        const Blend b = blend(p);
        const double first = input.temperature[index(b.first)];
        if (b.second_share == 0.0f) return first;
        const double second = input.temperature[index(b.second)];
        return std::sqrt(
            std::sqrt(std::lerp(std::pow(first, 4), std::pow(second, 4), double{b.second_share})));
    });
    frame.planes.push_back({"range", "m", view.centre_range});
    add("facet", "1", -1.0f, [&](std::size_t f) { return f; });
    add("object", "1", -1.0f,
        [&](std::size_t f) { return static_cast<unsigned>(facets.object[f]); });
    add_pixels("material", "1", -1.0f, [&](std::size_t p) {
        const Blend b = blend(p);
        return index(facets.material[index(b.second_share > 0.5f ? b.second : b.first)]);
    });
    add("normal.X", "1", nothing, [&](std::size_t f) { return facets.normal[f].x(); });
    add("normal.Y", "1", nothing, [&](std::size_t f) { return facets.normal[f].y(); });
    add("normal.Z", "1", nothing, [&](std::size_t f) { return facets.normal[f].z(); });
}

}  // namespace diurna
