#include "thermal/point/point_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/point/point_facet.hpp"
#include "thermal/weather/tilted_sky.hpp"

namespace diurna {

namespace {

constexpr double day = 86400.0;

/// What the weather sends to the job's facet.
class PointWeather {
 public:
    explicit PointWeather(const PointJob& job)
        : job_(job),
          sun_(job.site),
          normal_(direction(job.aspect_deg, 90.0 - job.slope_deg)),
          tilted_(job.clear_sky.longwave_by_direction
                      ? tilted_sky_excess(radians(job.slope_deg), job.sky_view)
                      : 0.0) {}

    double up_cosine() const { return normal_.z(); }

    PointForcing operator()(Instant when) {
        const Forcing forcing = job_.weather.at(when);
        const SkyState sky = sky_state(sun_.at(when), job_.elevation, forcing, job_.clear_sky);
        const double hidden = 1.0 - job_.sky_view;
        PointForcing f{
            .air = forcing.air,
            .wind_speed = forcing.wind_speed,
            .rain_mm_h = forcing.rain_mm_h,
            .albedo = sky.albedo,
            .longwave_in = job_.sky_view * sky.longwave_down + tilted_ * sky.tilted_longwave,
            .own_view = hidden};
        if (std::isnan(sky.plane_of_array)) {
            f.sunlight = facet_sunlight(sky, normal_.dot(sky.to_sun), 1.0, job_.sky_view);
            f.own_light = hidden * sky.global_horizontal();
        } else {
            f.sunlight = sky.plane_of_array;
        }
        if (job_.airspeed > 0.0) {
            f.air.temperature = recovery_temperature(f.air.temperature, job_.airspeed);
            f.wind_speed = job_.airspeed;
        }
        return f;
    }

 private:
    const PointJob& job_;
    SunPath sun_;
    Eigen::Vector3d normal_;
    double tilted_;
};

/// Finds the state that a span of steps leads back to itself, by Newton on the periodic map. The
/// first pass chooses the steps, the others repeat them; what stands on the surface follows from
/// pass to pass. Returns the passes taken.
int make_periodic(PointFacet& facet, Instant from, Instant to, double& residual) {
    constexpr int most_passes = 30;
    constexpr double tolerance = 1e-6, settled_water = 1e-3;  // [K], [mm]
    const auto n = static_cast<Eigen::Index>(facet.u.size());
    std::vector<double> steps;
    residual = 0.0;
    double before = 1e9;
    bool plain = false;
    for (int passes = 1; passes <= most_passes; ++passes) {
        const std::vector<double> start = facet.u;
        const Standing standing = facet.standing;
        facet.renew_snow();
        Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
        if (passes == 1) {
            facet.advance(from, to, &steps, &map);
        } else {
            facet.repeat(from, steps, map);
        }
        residual = 0.0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            residual = std::max(residual, std::abs(facet.u[i] - start[i]));
        }
        const double wetter = std::abs(facet.standing.water - standing.water) +
                              std::abs(facet.standing.frost - standing.frost);
        if (residual <= tolerance && wetter <= settled_water) return passes;
        // Where a front of freezing passes other nodes than it did, the map before misleads: a
        // plain pass brings it on its way.
        const bool astray = residual > 0.5 * before && !plain;
        plain = astray && !facet.column.linear();
        before = residual;
        if (!plain) facet.close_period(start, map);
    }
    return most_passes;
}

PointRow row_of(const PointFacet& facet, Instant when, double melt) {
    const SurfaceTerms terms = facet.terms(when);
    const HeatBalance& b = terms.balance;
    return {.instant = when,
            .surface_temperature = terms.radiometric,
            .absorbed_solar = b.absorbed_solar,
            .longwave_in = b.longwave_in,
            .longwave_out = b.longwave_out,
            .sensible = b.sensible,
            .latent = b.latent,
            // The ground takes what the other terms leave over.
            .conducted = -b.sum(),
            .back_temperature = facet.column.temperature(facet.column.size() - 1, facet.u.back()),
            .ground_temperature = facet.column.temperature(0, facet.u[0]),
            .leaf_temperature = terms.leaf,
            .water_mm = facet.standing.water,
            .frost_mm = facet.standing.frost,
            .melt = melt};
}

/// The first day as one that may have gone before itself: what its air and sky gained or lost from
/// end to end is taken out evenly, so that it ends as it began. A front that came through is
/// weather of that day and none of the days before.
Weather without_trend(Weather weather, Instant start) {
    constexpr double window = 3600.0;  // [s] averaged at either end
    const Instant end = later(start, day);
    const auto mean = [&](Instant from, double Forcing::*flux, double AirState::*air) {
        double sum = 0.0;
        constexpr int parts = 12;
        for (int i = 0; i < parts; ++i) {
            const Forcing f = weather.at(later(from, window * (i + 0.5) / parts));
            sum += flux ? f.*flux : f.air.*air;
        }
        return sum / parts;
    };
    const auto gain = [&](double Forcing::*flux, double AirState::*air) {
        return mean(later(end, -window), flux, air) - mean(start, flux, air);
    };
    const double warmer = gain(nullptr, &AirState::temperature);
    const double moister = gain(nullptr, &AirState::vapour_pressure);
    const double brighter = gain(&Forcing::longwave_down, nullptr);
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const double share = std::clamp(seconds_between(start, weather.instant[i]) / day, 0.0, 1.0);
        Forcing& f = weather.sample[i];
        f.air.temperature -= share * warmer;
        f.air.vapour_pressure = std::clamp(f.air.vapour_pressure - share * moister, 0.0,
                                           saturation_vapour_pressure(f.air.temperature));
        if (!std::isnan(brighter)) f.longwave_down -= share * brighter;
    }
    return weather;
}

/// Takes the freezing out of a surface's layers; whether there was any.
bool forget_freezing(ThermalSurface& surface) {
    bool any = false;
    for (Layer& layer : surface.layers) {
        if (!std::holds_alternative<Freezing>(layer.law)) continue;
        layer.law = Constant{};
        any = true;
    }
    return any;
}

/// The given profile at a depth.
double profile_at(const std::vector<SoilPoint>& profile, double depth) {
    const auto below =
        std::upper_bound(profile.begin(), profile.end(), depth,
                         [](double value, const SoilPoint& point) { return value < point.depth; });
    if (below == profile.begin()) return profile.front().temperature;
    if (below == profile.end()) return profile.back().temperature;
    const SoilPoint &a = *(below - 1), &b = *below;
    return std::lerp(a.temperature, b.temperature, (depth - a.depth) / (b.depth - a.depth));
}

double initial_temperature(const PointJob& job) {
    if (!std::isnan(job.initial_temperature)) return job.initial_temperature;
    if (const auto* fixed = std::get_if<FixedTemperature>(&job.surface.bottom)) {
        return fixed->temperature;
    }
    return job.weather.at(job.start).air.temperature;
}

}  // namespace

PointResult run_column(const PointJob& given) {
    PointJob job = given;
    const bool longwave_missing =
        std::any_of(job.weather.sample.begin(), job.weather.sample.end(),
                    [](const Forcing& f) { return std::isnan(f.longwave_down); });
    if (longwave_missing) infer_cloud(job.weather, job.site, job.elevation, job.clear_sky);

    PointJob before = job;
    if (job.spin_up == SpinUp::first_day && seconds_between(job.start, job.end) >= 0.99 * day) {
        before.weather = without_trend(job.weather, job.start);
    }
    PointWeather weather(job), weather_before(before);
    const LouisForm louis =
        louis_form(job.surface.roughness_length, job.surface.heat_roughness_length,
                   job.weather.wind_height, job.weather.air_height);
    const auto setup = [&](const ThermalSurface& surface, PointWeather& from) {
        return PointSetup{.surface = surface,
                          .louis = louis,
                          .up_cosine = weather.up_cosine(),
                          .wind_height = job.weather.wind_height,
                          .longitude_deg = job.site.longitude_deg,
                          .reference = job.weather.at(job.start).air.temperature,
                          .grid = point_grid(job.surface),
                          .longest_step = job.longest_step,
                          .tolerance = job.tolerance,
                          .knot = job.weather.instant,
                          .forcing = [&from](Instant when) { return from(when); }};
    };
    PointFacet facet(setup(job.surface, weather));
    PointResult result;
    result.note = job.weather.note;
    result.has_back = job.surface.back.has_value();
    result.has_canopy = !std::holds_alternative<std::monostate>(job.surface.canopy);
    result.has_store = job.surface.store.capacity_mm > 0.0;
    result.has_melt =
        result.has_store ||
        std::any_of(job.surface.layers.begin(), job.surface.layers.end(),
                    [](const Layer& layer) { return std::holds_alternative<Melting>(layer.law); });
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        const double start = job.initial_profile.empty()
                                 ? initial_temperature(job)
                                 : profile_at(job.initial_profile, facet.column.depth(i));
        facet.u[i] = facet.column.state_of(i, start);
    }
    if (job.spin_up != SpinUp::none) {
        const Instant end =
            job.spin_up == SpinUp::periodic ? job.end : std::min(job.end, later(job.start, day));
        if (ThermalSurface plain = job.surface; forget_freezing(plain)) {
            // Phases first: a front that must cross the column moves a node or two a pass.
            PointFacet first(setup(plain, weather_before));
            for (std::size_t i = 0; i < first.u.size(); ++i) {
                first.u[i] = first.column.state_of(i, facet.column.temperature(i, facet.u[i]));
            }
            result.passes = make_periodic(first, job.start, end, result.periodic_residual);
            for (std::size_t i = 0; i < facet.u.size(); ++i) {
                facet.u[i] = facet.column.state_of(i, first.column.temperature(i, first.u[i]));
            }
        }
        PointFacet settled(setup(job.surface, weather_before));
        settled.u = facet.u;
        result.passes += make_periodic(settled, job.start, end, result.periodic_residual);
        facet.go_on_from(settled);
    }

    const auto rows =
        static_cast<long long>(std::floor(seconds_between(job.start, job.end) / job.step + 1e-9));
    result.row.push_back(row_of(facet, job.start, 0.0));
    for (long long i = 0; i < rows; ++i) {
        const Instant from = later(job.start, double(i) * job.step);
        const Instant to = later(job.start, double(i + 1) * job.step);
        const double melted = facet.advance(from, to);
        result.row.push_back(row_of(facet, to, melted / job.step));
    }
    result.worst_energy_closure = facet.count.worst_closure;
    result.steps = facet.count.steps;
    result.rejected = facet.count.rejected;
    result.limited = facet.count.limited;
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        result.depth.push_back(facet.column.depth(i));
        result.final_profile.push_back(facet.column.temperature(i, facet.u[i]));
    }
    return result;
}

std::string column_csv(const PointResult& result) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    if (!result.note.empty()) fmt::format_to(out, "# {}\n", result.note);
    fmt::format_to(out,
                   "time,surface_temperature_K,absorbed_solar_W_m2,longwave_in_W_m2,"
                   "longwave_out_W_m2,sensible_W_m2,latent_W_m2,conducted_W_m2{}{}{}{}\n",
                   result.has_back ? ",back_temperature_K" : "",
                   result.has_canopy ? ",ground_temperature_K,leaf_temperature_K" : "",
                   result.has_store ? ",water_mm,frost_mm" : "",
                   result.has_melt ? ",melt_W_m2" : "");
    for (const PointRow& r : result.row) {
        fmt::format_to(out, "{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}",
                       format_instant(r.instant), r.surface_temperature, r.absorbed_solar,
                       r.longwave_in, r.longwave_out, r.sensible, r.latent, r.conducted);
        if (result.has_back) fmt::format_to(out, ",{:.4f}", r.back_temperature);
        if (result.has_canopy) {
            fmt::format_to(out, ",{:.4f},{:.4f}", r.ground_temperature, r.leaf_temperature);
        }
        if (result.has_store) fmt::format_to(out, ",{:.5f},{:.5f}", r.water_mm, r.frost_mm);
        if (result.has_melt) fmt::format_to(out, ",{:.4f}", r.melt);
        fmt::format_to(out, "\n");
    }
    return fmt::to_string(text);
}

}  // namespace diurna
