#include "materials/atmosphere/paths_in_bands.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Length [km] of the line from one height to another under a zenith angle at its start.
double range_to_height(double from_km, double to_km, double zenith_deg) {
    const double r0 = earth_radius_km + from_km, r1 = earth_radius_km + to_km;
    const double along = r0 * std::cos(radians(zenith_deg));
    const double inside = along * along + r1 * r1 - r0 * r0;
    if (inside >= 0.0) {
        for (const double range : {-along - std::sqrt(inside), -along + std::sqrt(inside)}) {
            if (range > 0.0) return range;
        }
    }
    throw InputError(
        "path", fmt::format("a path from {:g} km with zenith angle {:g}° never reaches {:g} km",
                            from_km, zenith_deg, to_km));
}

}  // namespace

SightLine line_of(const AirPath& a, const BandModel& model) {
    const auto check_km = [](const char* key, const std::optional<double>& value, Range range) {
        if (value) check_within(key, *value, range.least, range.most);
    };
    check_km("height_km", a.height_km, AirPath::heights_km);
    check_km("to_height_km", a.to_height_km, AirPath::heights_km);
    check_km("range_km", a.range_km, AirPath::ranges_km);
    check_within("zenith_deg", a.zenith_deg, 0.0, 180.0);
    check_within("sun_zenith_deg", a.sun_zenith_deg.value_or(0.0), 0.0, 180.0);
    check_within("azimuth_from_sun_deg", a.azimuth_from_sun_deg, -360.0, 360.0);
    check_within("ground_albedo", a.ground_albedo, 0.0, 1.0);
    const int ends = a.range_km.has_value() + a.to_height_km.has_value() + a.to_ground + a.to_space;
    if (ends != 1) {
        throw InputError("path", fmt::format("found {} ends of the path, expected one of range_km, "
                                             "to_height_km, to_ground, to_space",
                                             ends));
    }
    if (a.range_km) return sight_line(a.height_km, a.zenith_deg, *a.range_km);
    if (a.to_height_km) {
        return sight_line(a.height_km, a.zenith_deg,
                          range_to_height(a.height_km, *a.to_height_km, a.zenith_deg));
    }
    if (a.to_ground != ends_on_ground(model, a.height_km, a.zenith_deg)) {
        throw InputError("path", fmt::format("a path from {:g} km with zenith angle {:g}° ends {}",
                                             a.height_km, a.zenith_deg,
                                             a.to_ground ? "in space, not at the ground"
                                                         : "at the ground, not in space"));
    }
    return line_of(model, a.height_km, a.zenith_deg);
}

std::vector<PathInBand> paths_in_bands(const AirPath& a, const BandModel& model,
                                       const SightLine& line, std::span<const Band> bands) {
    std::vector<PathInBand> results;
    for (const Band& band : bands) {
        const PathSpectrum path = path_at_nodes(model, line, band.node_um);
        PathInBand& result = results.emplace_back();
        result.transmittance = band_mean_nodes(band, path.transmittance);
        result.thermal = band_sum_nodes(band, path.radiance);
        double left = 0.0, all = 0.0;
        for (std::size_t i = 0; i < band.node_um.size(); ++i) {
            const double slope = band.weight[i] * planck_derivative(band.node_um[i], contrast_body);
            left += slope * path.transmittance[i];
            all += slope;
        }
        result.contrast = all > 0.0 ? left / all : result.transmittance;
        result.scattered = 0.0;
        if (!a.sun_zenith_deg) continue;
        const SunField field(model,
                             {.zenith_deg = *a.sun_zenith_deg, .ground_albedo = a.ground_albedo},
                             band.node_um);
        result.scattered = band_sum_nodes(
            band, a.to_space ? field.sky(a.height_km, a.zenith_deg, a.azimuth_from_sun_deg)
                             : field.path(line, a.zenith_deg, a.azimuth_from_sun_deg));
    }
    return results;
}

}  // namespace diurna
