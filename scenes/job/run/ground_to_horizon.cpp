#include "scenes/job/run/ground_to_horizon.hpp"

namespace diurna {

std::vector<BorderFacet> far_ground_facets(const BorderGround& border, const FacetSet& facets,
                                           std::span<const float> sky_view) {
    constexpr float level = 0.99f, open = 0.95f;  // upward part of the normal; sky view
    std::vector<BorderFacet> found;
    for (const BorderFacet& of : border.facet) {
        if (facets.normal[of.facet].z() < level || sky_view[of.facet] < open) continue;
        found.push_back(of);
    }
    return found.empty() ? border.facet : found;
}

std::optional<FarGround> far_ground(const World& world, const FacetSet& facets,
                                    std::span<const float> temperature,
                                    std::span<const float> sky_view) {
    const std::optional<BorderGround> border = border_ground(world, facets);
    if (!border) return std::nullopt;
    double kelvin = 0.0, length = 0.0;
    for (const BorderFacet& of : far_ground_facets(*border, facets, sky_view)) {
        kelvin += double(of.length) * double(temperature[of.facet]);
        length += double(of.length);
    }
    return FarGround{.material = border->material,
                     .temperature = kelvin / length,
                     .height_km = 1e-3 * border->height};
}

bool sees_beyond(const View& view, double border_height, double ground_height) {
    return view.extent.sky_pixels > 0 &&
           looks_below_horizon(ground_height + view.observer_height, border_height,
                               double(view.extent.sky_zenith_deg[1]));
}

std::optional<FarGround> seen_beyond(const View& view, const std::optional<FarGround>& ground,
                                     double ground_height_km) {
    const bool seen = ground && sees_beyond(view, 1e3 * ground->height_km, 1e3 * ground_height_km);
    return seen ? ground : std::nullopt;
}

}  // namespace diurna
