// Time against error of facets that water, snow or ice lie on, or whose ground freezes: open slopes
// of all aspects, 0 to 40 degrees, in a day of rain, of snowfall and of frost; marched through the
// day, and until the day closes. Time is of the processor, on one thread; the first pass of plain
// columns, from which they set out, is within. The reference takes steps of 30 s.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/matter/read_library.hpp"
#include "terrain/place/instant.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;

namespace {

struct Case {
    const char* name;
    const char* material;
    double mean, swing;  // [K] of the air
    double rain_mm_h;    // from 09:00 to 13:00
    double sun;          // [W m⁻²] at noon
};

Weather weather_of(const Case& c, Instant start) {
    Weather weather;
    for (int hour = 0; hour <= 24; ++hour) {
        const double day = 2.0 * std::numbers::pi * (hour - 15) / 24.0;
        Forcing now;
        now.air.temperature = c.mean + c.swing * std::cos(day);
        now.air.vapour_pressure = 0.8 * 611.2 * std::exp(0.072 * (c.mean - c.swing - 273.15));
        now.wind_speed = 3.0;
        now.shortwave_down = c.sun * std::max(0.0, -std::cos(2.0 * std::numbers::pi * hour / 24.0));
        now.longwave_down = 0.8 * 5.670374419e-8 * std::pow(now.air.temperature, 4);
        if (hour >= 9 && hour < 13) now.rain_mm_h = c.rain_mm_h;
        weather.instant.push_back(later(start, 3600.0 * hour));
        weather.sample.push_back(now);
    }
    return weather;
}

/// Open slopes, all under one sky.
struct Slopes {
    FacetSet facets{};
    FacetViews views{};

    Slopes(MaterialId material, std::size_t count) {
        for (std::size_t f = 0; f < count; ++f) {
            const double tilt = 40.0 / 180.0 * std::numbers::pi * double(f % 9) / 8.0;
            const double facing = 2.0 * std::numbers::pi * double(f) / double(count);
            facets.normal.push_back(Eigen::Vector3d(std::sin(tilt) * std::sin(facing),
                                                    std::sin(tilt) * std::cos(facing),
                                                    std::cos(tilt))
                                        .cast<float>());
            facets.centroid.emplace_back(0.0f, 0.0f, 0.0f);
            facets.area.push_back(1.0f);
            facets.material.push_back(material);
            facets.object.push_back(ObjectId{0});
            views.sky.push_back(float(0.5 + 0.5 * std::cos(tilt)));
            views.below.push_back(float(0.5 - 0.5 * std::cos(tilt)));
        }
        views.others.row.assign(count + 1, 0);
    }
};

SolveResult run(const Slopes& slopes, const MaterialLibrary& library, const Weather& weather,
                const SolveOptions& options) {
    const SunExposure sun{.instant = step_instants(options), .fraction = {}};
    return solve({.facets = slopes.facets,
                  .views = slopes.views,
                  .sun = sun,
                  .materials = library,
                  .weather = weather,
                  .site = {.latitude_deg = 47.0, .longitude_deg = 0.0}},
                 options);
}

void row(const Case& c, bool periodic) {
    const std::size_t facets = periodic ? 128 : 1024;
    const MaterialLibrary library = default_material_library();
    const Slopes slopes(library.find(c.material), facets);
    SolveOptions options;
    options.start = parse_instant("2026-02-15T00:00:00Z");
    options.keep_every = options.step;
    options.exchange = false;
    options.periodic = periodic;
    const Weather weather = weather_of(c, options.start);
    SolveOptions fine = options;
    fine.refinement = 20;
    const TemperatureField exact = run(slopes, library, weather, fine).temperature;
    SolveResult result;
    double seconds = 1e9;
    for (int again = 0; again < 3; ++again) {
        result = run(slopes, library, weather, options);
        seconds = std::min(seconds, result.report.step_cpu_seconds);
    }
    double sum = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < exact.kelvin.size(); ++i) {
        const double e = double(result.temperature.kelvin[i]) - exact.kelvin[i];
        sum += e * e;
        worst = std::max(worst, std::abs(e));
    }
    const std::string setting =
        fmt::format("{} followed {} passes {} {:.0f} facet-days/s", c.material,
                    result.report.points, result.report.point_passes, double(facets) / seconds);
    for (const bool is_worst : {false, true}) {
        fmt::print("{},{},{},{},1,{:.4f},{:.4f},{}\n", c.name, periodic ? "closed" : "marched",
                   setting, facets, seconds,
                   is_worst ? worst : std::sqrt(sum / double(exact.kelvin.size())),
                   is_worst ? "K worst" : "K rms");
    }
    std::fflush(stdout);
}

}  // namespace

int main() {
    set_thread_count(1);
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    for (const Case& c : {Case{"rain", "asphalt", 285.0, 5.0, 2.0, 500.0},
                          Case{"rain", "grass", 285.0, 5.0, 2.0, 500.0},
                          Case{"snowfall", "asphalt", 268.0, 3.0, 1.0, 400.0},
                          Case{"old_snow", "snow", 268.0, 5.0, 0.0, 500.0},
                          Case{"frost", "grass", 271.0, 4.0, 0.0, 450.0}}) {
        row(c, false);
        // Snow that falls day by day closes no day.
        if (c.mean + c.swing > 273.0 || c.rain_mm_h == 0.0) row(c, true);
    }
    return 0;
}
