#include "scenes/job/world/air.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/upper_air.hpp"

namespace diurna {

Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant) {
    return atmosphere_over(scene, world, weather, heights_of_ground(world), instant);
}

Atmosphere atmosphere_over(const Scene& scene, const World& world, const Weather& weather,
                           const HeightSpan& ground, Instant instant) {
    return atmosphere_of(scene, world, weather, ground, weather.at(instant));
}

Atmosphere atmosphere_of(const Scene& scene, const World& world, const Weather& weather,
                         const HeightSpan& ground, const Forcing& forcing) {
    const AirInput& air = scene.air;
    if (air.vacuum) return Vacuum{};
    const double ground_km = world.sea_level_height / 1000.0;
    Profile profile = profile_over(*upper_air(scene, weather), air_by_height(scene, weather),
                                   forcing.air, ground.low, ground.high);
    if (air.table) return Tabulated{air.table, std::make_shared<const Profile>(std::move(profile))};
    BandModel model;
    model.profile = std::move(profile);
    model.aerosol = air.aerosol;
    model.visibility_km = air.visibility_km;
    model.co2_ppm = air.co2_ppm;
    model.ground_km = std::max(0.0, ground_km);
    model.rain_mm_h = forcing.rain_mm_h;
    if (!std::isnan(forcing.cloud_fraction)) model.cloud.fraction = forcing.cloud_fraction;
    model.cloud.base_km = ground_km + air.cloud_base_km;
    model.cloud.depth_km = air.cloud_depth_km;
    return model;
}

void check_table(const Scene& scene, const World& world, std::span<const Observer> observers) {
    if (!scene.air.table) return;
    const TableSpan span = scene.air.table->span;
    const std::string where = scene.file.string() + ": atmosphere.table";
    constexpr double slack = 1e-3;  // [km]
    const auto inside = [&](const char* what, double low, double high, double least, double most) {
        if (low >= least - slack && high <= most + slack) return;
        throw InputError(
            where,
            fmt::format("{} from {:.3f} to {:.3f} km, but the table covers {:.3f} to {:.3f} km",
                        what, low, high, least, most));
    };
    const double sea_km = world.sea_level_height / 1000.0;
    const HeightSpan ground = heights_of_surfaces(world);
    const double low = std::min(sea_km, 1e-3 * ground.low);
    const double high = std::max(sea_km, 1e-3 * ground.high);
    double farthest = 0.0;
    inside("surfaces are at heights", low, high, span.least_to_km, span.most_to_km);
    inside("surfaces with a view of the sky are at heights", low, high, span.least_sky_km,
           span.most_sky_km);
    for (const Observer& observer : observers) {
        const double eye_km = 1e-3 * height_above_sea(world, observer.position);
        inside("observers are at heights", eye_km, eye_km, span.least_from_km, span.most_from_km);
        inside("observers with a view of the sky are at heights", eye_km, eye_km, span.least_sky_km,
               span.most_sky_km);
        for (const Eigen::Vector3f& vertex : world.facets.vertex) {
            farthest = std::max(farthest, (vertex.cast<double>() - observer.position).norm());
        }
        // Beyond the mesh the plain goes on to its horizon.
        const double above_km = std::max(0.0, eye_km - sea_km);
        farthest = std::max(
            farthest, 1e3 * std::sqrt(above_km * (2.0 * (earth_radius_km + sea_km) + above_km)));
    }
    inside("lines of sight, to the plain's horizon, have ranges", 0.0, 1e-3 * farthest, 0.0,
           span.most_range_km);
}

std::vector<std::string> table_notes(const Scene& scene) {
    if (!scene.air.table) return {};
    return {
        fmt::format("the atmosphere is a table of {} paths from {}, the same at every instant: "
                    "rain, cloud and scattered sunlight do not affect the path radiance; the "
                    "interpolation error between its paths is not measured",
                    scene.air.table->span.paths, scene.air.table_file.filename().string())};
}

}  // namespace diurna
