#include "scenes/job/run/ground_to_horizon.hpp"

namespace diurna {

std::optional<FarGround> far_ground(const World& world, const FacetSet& facets,
                                    std::span<const float> temperature,
                                    std::span<const float> sky_view) {
    constexpr float level = 0.99f, open = 0.95f;  // upward part of the normal; sky view
    const std::optional<BorderGround> border = border_ground(world, facets);
    if (!border) return std::nullopt;
    double kelvin = 0.0, length = 0.0, any_kelvin = 0.0, any_length = 0.0;
    for (const BorderFacet& of : border->facet) {
        const double part = double(of.length) * double(temperature[of.facet]);
        any_kelvin += part;
        any_length += double(of.length);
        if (facets.normal[of.facet].z() < level || sky_view[of.facet] < open) continue;
        kelvin += part;
        length += double(of.length);
    }
    return FarGround{.material = border->material,
                     .temperature = length > 0.0 ? kelvin / length : any_kelvin / any_length,
                     .height_km = 1e-3 * border->height};
}

std::optional<FarGround> seen_beyond(const View& view, const std::optional<FarGround>& ground,
                                     double ground_height_km) {
    if (!ground || view.extent.sky_pixels == 0) return std::nullopt;
    const double eye = 1e3 * ground_height_km + view.observer_height;
    const bool seen =
        looks_below_horizon(eye, 1e3 * ground->height_km, double(view.extent.sky_zenith_deg[1]));
    return seen ? ground : std::nullopt;
}

}  // namespace diurna
