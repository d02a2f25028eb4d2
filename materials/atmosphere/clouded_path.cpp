#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/atmosphere/band_transmittance.hpp"
#include "materials/atmosphere/cloud_on_line.hpp"
#include "materials/atmosphere/sunlit_path.hpp"

namespace diurna {

namespace {

constexpr double nothing = 1e-3;  // of light: no more of it is followed

/// A line through the cloud, and the line from its beginning onward to the eye.
struct CloudedLine {
    const SightLine& line;
    const CloudCrossing& crossing;
    std::span<const double> turn;
    const SightLine& onward;
};

/// Of a line through the cloud, where it is covered: the light scattered before the cloud, the face
/// of the cloud and the share `through` of the light beyond, times `scale`.
///
/// - face: (bin) irradiance that the face seen sends, 0 where negative
template <class Face>
ScatteredLight light_with_cloud(const SunlitAir& air, const CloudedLine& clouded, const Face& face,
                                double through, double scale) {
    const auto& [line, crossing, turn, onward] = clouded;
    const SightLine before = line_before(line, crossing), beyond = line_behind(line, crossing);
    ScatteredLight light = scattered_light(air, before, turn, true, true, onward);
    const SightLine to_eye = joined(onward, before);
    const std::vector<double> tau = transmittance(air.model, to_eye, air.bins);
    for (std::size_t b = 0; b < tau.size(); ++b) {
        const double seen = tau[b] * std::max(0.0, face(b)) * std::numbers::inv_pi;
        for (std::vector<double>& of_turn : light.at_turn) of_turn[b] += seen;
    }
    if (through <= nothing || beyond.size() == 0) return light;
    const ScatteredLight rest = scattered_light(air, beyond, turn, true, true, to_eye);
    const double share = through * scale;
    for (std::size_t b = 0; b < tau.size(); ++b) {
        for (std::size_t a = 0; a < turn.size(); ++a) {
            light.at_turn[a][b] += share * rest.at_turn[a][b];
        }
        light.by_cosine[b] += share * rest.by_cosine[b];
    }
    return light;
}

double through_cloud(const BandModel& model, const CloudCrossing& crossing) {
    return std::exp(-model.cloud.optical_depth / crossing.cosine);
}

/// Of a line that falls through the cloud: its top, equally bright at every angle, and the light
/// from below it.
ScatteredLight light_over_cloud(const SunlitAir& air, const CloudedLine& clouded) {
    const BandModel& model = air.model;
    const double through = through_cloud(model, clouded.crossing);
    const std::size_t base = air.at_height(model.cloud.base_km).low;
    const std::vector<double>&below = air.cloudy.up.value[base],
          &above = air.cloudy.up.value[base + 1];
    const auto top = [&](std::size_t b) { return above[b] - through * below[b]; };
    return light_with_cloud(air, clouded, top, through, model.scale.diffuse);
}

/// Of a line that rises through the cloud: its base and the light from above it. So objects behind
/// a thick cloud look like the sky beside them.
ScatteredLight light_under_cloud(const SunlitAir& air, const CloudedLine& clouded) {
    const BandModel& model = air.model;
    const double through = through_cloud(model, clouded.crossing);
    const std::size_t drops = air.at_height(model.cloud.base_km).low;
    const std::vector<double>&below = air.cloudy.down.value[drops],
          &above = air.cloudy.down.value[drops + 1];
    const double shape = base_brightness(model.cloud, clouded.crossing.cosine);
    const auto base = [&](std::size_t b) { return shape * below[b] - through * above[b]; };
    return light_with_cloud(air, clouded, base, through, 1.0);
}

}  // namespace

HermiteWeights in_clouded_air(const SunlitAir& air, double height_km) {
    const CloudLayer& cloud = air.model.cloud;
    const std::size_t drops = air.at_height(cloud.base_km).low;
    return air.at_height(height_km < cloud.top_km() ? std::min(height_km, air.level[drops])
                                                    : std::max(height_km, air.level[drops + 1]));
}

double base_brightness(const CloudLayer& cloud, double cosine) {
    const double thick = -std::expm1(-0.25 * cloud.optical_depth);
    return std::lerp(1.0, 3.0 / 7.0 * (1.0 + 2.0 * cosine), thick);
}

ScatteredLight scattered_light(const SunlitAir& air, const SightLine& line,
                               std::span<const double> turn, const SightLine& onward) {
    ScatteredLight light = scattered_light(air, line, turn, false, true, onward);
    const double covered = air.model.cloud.over_sun();
    const double scale = air.model.scale.diffuse;
    const auto crossing = cloud_crossing(air.model, line);
    // A line that starts within the cloud sees what its base sends down, whichever way it goes.
    const bool over = crossing && line.height_within(0, 0.0) >= air.model.cloud.top_km();
    if (covered > 0.0) {
        light.mix(covered, !crossing ? scattered_light(air, line, turn, true, true, onward)
                           : over    ? light_over_cloud(air, {line, *crossing, turn, onward})
                                     : light_under_cloud(air, {line, *crossing, turn, onward}));
    }
    if (scale != 1.0 && line.size() > 0 && below_cloud(air.model, line.height_within(0, 0.0))) {
        light.scale(scale);
    }
    return light;
}

}  // namespace diurna
