#include "scenes/job/world/light_at_heights.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <variant>

#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna {

namespace {

constexpr double hour_s = 3600.0, usual_visibility_km = 23.0, level_ground = 50.0;
constexpr double lowest_lit_deg = 0.5, least_watts = 0.1;
constexpr std::size_t most_hours = 200;

bool thick_haze(const AirInput& air) {
    return air.aerosol.starts_with("fog") ||
           (air.aerosol != "none" && air.visibility_km < usual_visibility_km);
}

/// Where the light is computed: on both sides of the cloud's top and in steps between.
std::vector<double> heights_of_light(double low, double high, double station, double top,
                                     bool below) {
    constexpr double step = 150.0, beside = 0.1, most_steps = 20.0;
    std::vector<double> heights;
    const auto add = [&](double from, double to) {
        const double steps = std::clamp(std::ceil((to - from) / step), 1.0, most_steps);
        for (double i = 0.0; i <= steps; ++i) heights.push_back(from + (to - from) * i / steps);
    };
    if (below) {
        add(std::min(low, station), std::min(std::max(high, station), top - beside));
        heights.push_back(station);
    }
    if (high >= top) add(top + beside, std::max(high, top + 2.0 * beside));
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end(),
                              [](double a, double b) { return b - a < 1e-3; }),
                  heights.end());
    return heights;
}

/// An hour whose light is that of others like it in a long span.
struct LitHour {
    Instant when{};
    SkyState sky;
    Forcing now;

    /// The sun's height in steps that widen with it, the beam's share, the cloud, the warmth.
    using Alike = std::tuple<int, int, int, int>;
    Alike kind() const {
        const double all = sky.direct_normal + sky.diffuse_horizontal;
        const double up = std::max(0.0, sky.sun.elevation_deg);
        const double cloud = std::isnan(now.cloud_fraction) ? 0.0 : now.cloud_fraction;
        return {int(std::lround(8.0 * std::sqrt(up / 10.0))),
                all > 0.0 ? int(std::lround(8.0 * sky.direct_normal / all)) : -1,
                int(std::lround(4.0 * cloud)), int(std::lround(now.air.temperature / 5.0))};
    }
};

double over_formula(double light, double formula) {
    return formula > least_watts ? light / formula : 0.0;
}

/// One hour's ratios at all heights.
std::vector<LightRatio> ratios_of(const LightOfInstant& light, const LitHour& hour,
                                  const AirByHeight& rule, const std::vector<double>& heights,
                                  const ClearSky& clear, bool longwave) {
    static const Band solar = flat_band("sun", 0.3, 5.0, bin_edges_um(), 1);
    const auto& model = std::get<BandModel>(light.air);
    const SunPosition& sun = hour.sky.sun;
    std::optional<SunField> field;
    if (sun.elevation_deg >= lowest_lit_deg) {
        field.emplace(
            model, SunLight{.zenith_deg = 90.0 - sun.elevation_deg, .distance_au = sun.distance_au},
            solar.node_um);
    }
    std::vector<LightRatio> ratios;
    for (const double height : heights) {
        const AirState air = air_at_height(rule, hour.now.air, height);
        LightRatio& ratio = ratios.emplace_back();
        if (longwave) {
            ratio.longwave =
                ground_longwave(model, 1e-3 * height) / clear_longwave(air, clear.longwave);
        }
        if (!field) continue;
        const SunFlux flux = field->flux(1e-3 * height);
        const Sunlight formula = clear_sunlight(sun, air, height, reference_sky(clear));
        ratio.direct = over_formula(band_sum_nodes(solar, flux.direct), formula.direct_normal);
        ratio.diffuse = over_formula(band_sum_nodes(solar, flux.down), formula.diffuse_horizontal);
    }
    return ratios;
}

/// Gives hours of the dark the sunlight's ratios of the nearest lit ones, for the minutes between.
void fill_the_dark(const std::vector<LitHour>& hours, LightByHeight& light) {
    const std::size_t width = light.height.size();
    const auto lit = [&](std::size_t i) {
        return hours[i].sky.sun.elevation_deg >= lowest_lit_deg;
    };
    const auto take = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = 0; k < width; ++k) {
            light.ratio[to * width + k].direct = light.ratio[from * width + k].direct;
            light.ratio[to * width + k].diffuse = light.ratio[from * width + k].diffuse;
        }
    };
    for (std::size_t i = 0; i < hours.size(); ++i) {
        if (lit(i)) continue;
        std::size_t away = 1;
        for (; away <= hours.size(); ++away) {
            if (i + away < hours.size() && lit(i + away)) {
                take(i + away, i);
                break;
            }
            if (away <= i && lit(i - away)) {
                take(i - away, i);
                break;
            }
        }
    }
}

/// Whether some light is a cloud's: observed, inferred from sunlight, or to be inferred from
/// longwave.
bool may_have_cloud(const Weather& measured) {
    return std::any_of(measured.sample.begin(), measured.sample.end(), [](const Forcing& f) {
        return f.cloud_fraction > 0.0 || !std::isnan(f.longwave_down);
    });
}

std::shared_ptr<const LightByHeight> over_span(const Scene& scene, const World& world,
                                               const Weather& weather, const HeightSpan& span,
                                               double top) {
    const AirByHeight rule = air_by_height(scene, weather);
    const InstantLights lights(scene, world, weather);
    const Instant from = weather.instant.front(), to = std::max(weather.instant.back(), from);
    SunPath path(world.site);
    auto light = std::make_shared<LightByHeight>();
    std::vector<LitHour> hours;
    for (double s = 0.0; s <= seconds_between(from, to) + hour_s; s += hour_s) {
        const Instant when = later(from, s);
        hours.push_back(
            {when, lights.sky().at(when, path.at(when)), lights.sky().weather().at(when)});
        light->instant.push_back(when);
    }
    light->by_haze = thick_haze(scene.air);
    if (span.high >= top) light->cloud_top = top;
    light->height = heights_of_light(span.low, span.high, weather.height, top, light->by_haze);
    // What is computed, and which of these each hour takes.
    std::vector<std::size_t> computed, taken;
    std::map<LitHour::Alike, std::size_t> known;
    for (std::size_t i = 0; i < hours.size(); ++i) {
        const LitHour::Alike kind =
            hours.size() > most_hours ? hours[i].kind() : LitHour::Alike{int(i), 0, 0, 0};
        const auto [at, is_new] = known.try_emplace(kind, computed.size());
        if (is_new) computed.push_back(i);
        taken.push_back(at->second);
    }
    std::vector<std::vector<LightRatio>> found(computed.size());
    for_each_index(
        computed.size(),
        [&](std::size_t k) {
            const LitHour& hour = hours[computed[k]];
            found[k] = ratios_of(lights.at(scene, world, hour.when), hour, rule, light->height,
                                 scene.sky, span.high >= top);
        },
        1);
    for (const std::size_t k : taken) {
        light->ratio.insert(light->ratio.end(), found[k].begin(), found[k].end());
    }
    fill_the_dark(hours, *light);
    return light;
}

}  // namespace

std::shared_ptr<const LightByHeight> light_at_heights(const Scene& scene, const World& world,
                                                      const Weather& weather,
                                                      const Weather& measured) {
    const AirInput& air = scene.air;
    if (air.vacuum || air.table || air_by_height(scene, weather).same_everywhere()) return nullptr;
    const HeightSpan span = heights_of_surfaces(world);
    const double top = world.sea_level_height + 1e3 * (air.cloud_base_km + air.cloud_depth_km);
    if (weather.height >= top) return nullptr;
    const bool relief =
        span.high > weather.height + level_ground || span.low < weather.height - level_ground;
    const bool cloud = may_have_cloud(measured);
    if (!(cloud && span.high >= top) && !(thick_haze(air) && relief)) return nullptr;
    try {
        auto light = over_span(scene, world, weather, span, top);
        constexpr double same = 0.5;  // [m]
        if (!light->by_haze || std::abs(weather.height - world.sea_level_height) < same) {
            return light;
        }
        // Pictures are fitted at the origin, to the station's light carried there by this.
        Weather carried = weather;
        carried.by_height = std::move(light);
        return over_span(scene, world, carried, span, top);
    } catch (const InputError&) {
        // Weather that no profile can continue is reported by weather_warnings() and by pictures.
        return nullptr;
    }
}

}  // namespace diurna
