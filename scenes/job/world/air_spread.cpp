#include "scenes/job/world/air_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/light/directional_sky.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

namespace {

constexpr double hour = 3600.0;
constexpr double lowest_sun_deg = 0.5, least_diffuse = 0.1;  // [W m⁻²]
constexpr std::size_t most_by_time = 200;                    // instants; more go by their sky
constexpr std::array<double, 8> node_um = {0.36, 0.42, 0.48, 0.56, 0.66, 0.80, 1.02, 1.60};

/// Skies of a long span that are taken to be alike: the sun's height in steps that widen with it,
/// the beam's share of the light.
using Alike = std::pair<int, int>;
Alike kind_of(const SkyState& sky) {
    const double share = sky.direct_normal / (sky.direct_normal + sky.diffuse_horizontal);
    return {int(std::lround(8.0 * std::sqrt(sky.sun.elevation_deg / 10.0))),
            int(std::lround(12.0 * share))};
}

/// ∫ dλ by the trapezoidal rule.
std::array<double, node_um.size()> widths() {
    std::array<double, node_um.size()> width{};
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const double low = n > 0 ? node_um[n - 1] : 2.0 * node_um[0] - node_um[1];
        const double high = n + 1 < node_um.size() ? node_um[n + 1] : 2.0 * node_um[n] - low;
        width[n] = 0.5 * (high - low);
    }
    return width;
}

SkySpread spread_of(const LightOfInstant& light, const SkyState& sky, double height_km) {
    const auto& model = std::get<BandModel>(light.air);
    const double zenith_deg = 90.0 - sky.sun.elevation_deg;
    const SunField field(model, {.zenith_deg = zenith_deg, .distance_au = sky.sun.distance_au},
                         node_um);
    const std::vector<double> diffuse = field.flux(height_km).down;
    const SunlitShape shape = sunlit_shape(field, model, height_km, zenith_deg);
    static const auto width = widths();
    SkySpread spread;
    double all = 0.0;
    for (std::size_t n = 0; n < node_um.size(); ++n) all += width[n] * diffuse[n];
    if (!(all > 0.0)) return spread;
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const double share = width[n] * diffuse[n] / all;
        spread.circumsolar += share * shape.aureole[n] * std::sin(radians(sky.sun.elevation_deg));
        for (std::size_t k = 0; k < spread.uneven.size(); ++k) {
            spread.uneven[k] += static_cast<float>(share * shape.uneven[k][n]);
        }
    }
    spread.circumsolar = std::clamp(spread.circumsolar, 0.0, 1.0);
    return spread;
}

}  // namespace

namespace {

std::shared_ptr<const SkySpreads> spread_over_span(const Scene& scene, const World& world,
                                                   const Weather& weather) {
    const InstantLights lights(scene, world, weather);
    const Instant from = weather.instant.front(), to = std::max(weather.instant.back(), from);
    SunPath path(world.site);
    std::vector<Instant> instants;
    std::vector<SkyState> skies;
    for (double s = 0.0; s <= seconds_between(from, to) + hour; s += hour) {
        const Instant when = later(from, s);
        const SkyState sky = lights.sky().at(when, path.at(when));
        if (sky.sun.elevation_deg < lowest_sun_deg || sky.diffuse_horizontal < least_diffuse) {
            continue;
        }
        instants.push_back(when);
        skies.push_back(sky);
    }
    if (instants.empty()) return nullptr;
    if (!std::holds_alternative<BandModel>(lights.at(scene, world, instants.front()).air)) {
        return nullptr;
    }
    const double height_km = world.sea_level_height / 1000.0;
    // What is computed, and which of these each instant takes.
    std::vector<std::size_t> computed, taken;
    std::map<Alike, std::size_t> known;
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const Alike kind = instants.size() > most_by_time ? kind_of(skies[i]) : Alike{int(i), 0};
        const auto [at, is_new] = known.try_emplace(kind, computed.size());
        if (is_new) computed.push_back(i);
        taken.push_back(at->second);
    }
    std::vector<SkySpread> found(computed.size());
    for_each_index(
        computed.size(),
        [&](std::size_t k) {
            const std::size_t i = computed[k];
            found[k] = spread_of(lights.at(scene, world, instants[i]), skies[i], height_km);
        },
        1);
    SkySpreads spreads{.instant = std::move(instants), .spread = {}};
    for (const std::size_t k : taken) spreads.spread.push_back(found[k]);
    return std::make_shared<const SkySpreads>(std::move(spreads));
}

}  // namespace

std::shared_ptr<const SkySpreads> air_spread(const Scene& scene, const World& world,
                                             const Weather& weather) {
    try {
        return spread_over_span(scene, world, weather);
    } catch (const InputError&) {
        // Weather that no profile can continue is reported by weather_warnings() and by pictures.
        return nullptr;
    }
}

}  // namespace diurna
