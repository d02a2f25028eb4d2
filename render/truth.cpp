#include "render/truth.hpp"

#include <limits>

#include "terrain/parallel.hpp"

namespace diurna {

void add_truth(const View& view, const RadianceInput& input, Frame& frame) {
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    const FacetSet& facets = input.facets;
    const auto add = [&](const char* name, const char* unit, float sky, const auto& value) {
        Plane plane{name, unit, std::vector<float>(view.pixels(), sky)};
        for_each_index(
            view.pixels(),
            [&](std::size_t p) {
                if (view.centre[p] != no_facet) {
                    plane.pixel[p] = static_cast<float>(value(index(view.centre[p])));
                }
            },
            8192);
        frame.planes.push_back(std::move(plane));
    };
    add("temperature", "K", nothing, [&](std::size_t f) { return input.temperature[f]; });
    frame.planes.push_back({"range", "m", view.centre_range});
    add("facet", "1", -1.0f, [&](std::size_t f) { return f; });
    add("object", "1", -1.0f,
        [&](std::size_t f) { return static_cast<unsigned>(facets.object[f]); });
    add("material", "1", -1.0f, [&](std::size_t f) { return index(facets.material[f]); });
    add("normal.X", "1", nothing, [&](std::size_t f) { return facets.normal[f].x(); });
    add("normal.Y", "1", nothing, [&](std::size_t f) { return facets.normal[f].y(); });
    add("normal.Z", "1", nothing, [&](std::size_t f) { return facets.normal[f].z(); });
}

}  // namespace diurna
