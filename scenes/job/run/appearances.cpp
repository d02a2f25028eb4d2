#include "scenes/job/run/appearances.hpp"

#include <algorithm>

#include "scenes/job/run/sun_on_surfaces.hpp"
#include "scenes/job/world/light_source.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_instants = 4;
constexpr float white_in_the_sun = 100.0f;  // [K]
constexpr float under_the_sky = 0.15f;      // of that, in shade under an open sky

std::vector<Instant> some_of(std::span<const Instant> frames) {
    std::vector<Instant> some;
    const std::size_t count = std::min(frames.size(), most_instants);
    for (std::size_t i = 0; i < count; ++i) some.push_back(frames[i * frames.size() / count]);
    return some;
}

std::vector<float> sunlit_appearance(const Prepared& prepared, const FacetViews& views,
                                     const SunPosition& sun, const Band& band) {
    const FacetSet& facets = prepared.world.surfaces();
    const Eigen::Vector3f to_sun = sun_direction(sun).cast<float>();
    const std::vector<float> fraction = sun_on_surfaces(prepared, sun, 1);
    const double middle = 0.5 * (band.from_um() + band.to_um());
    std::vector<float> reflectance;
    for (std::size_t m = 0; m < prepared.scene.materials.size(); ++m) {
        const MaterialId id{static_cast<std::uint16_t>(m)};
        reflectance.push_back(
            static_cast<float>(prepared.scene.materials[id].reflectance.at(middle)));
    }
    std::vector<float> appearance(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const float direct = fraction[f] * std::max(0.0f, facets.normal[f].dot(to_sun));
        const float open = under_the_sky * static_cast<float>(views.sky[f]);
        appearance[f] = white_in_the_sun * reflectance[index(facets.material[f])] * (direct + open);
    }
    return appearance;
}

}  // namespace

std::vector<Appearance> appearances(const Prepared& prepared, std::span<const Instant> frames,
                                    const FacetViews& views, const TemperatureField& field,
                                    std::span<const Band> bands) {
    std::vector<Appearance> all;
    for (const Instant instant : some_of(frames)) {
        const std::vector<float> temperature = field.interpolate(instant);
        const SunPosition sun =
            light_source(sun_over(prepared, instant), prepared.world.site, instant, bands).place;
        for (const Band& band : bands) {
            if (band.to_um() > 3.0) {
                all.push_back(
                    {.facet = thermal_appearance(prepared.world.surfaces(), views,
                                                 prepared.scene.materials, temperature, band),
                     .sky = 250.0f});
            } else if (sun.elevation_deg > 0.0) {
                all.push_back({.facet = sunlit_appearance(prepared, views, sun, band),
                               .sky = white_in_the_sun * under_the_sky});
            }
        }
    }
    return all;
}

void without_textures(const TextureLevels& levels, Appearance& look) {
    if (levels.empty()) return;
    for (std::size_t f = levels.solid; f < look.facet.size(); ++f) {
        look.facet[f] = look.facet[index(levels.facet_of(surface_id(f)))];
    }
}

}  // namespace diurna
